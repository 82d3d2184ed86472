// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Scene files: what is accepted reads the same once written again. Checksums are set right first, or no input would get past them.
#include "scene_stream.h"

#include <cstring>
#include <sstream>

#include "foothold/base/checksum.h"
#include "fuzz.h"

namespace {

/// Takes whatever it is given.
struct Bytes : foothold::Persistent {
  void save(std::ostream& stream) const override { stream << bytes; }
  void load(std::istream& stream) override {
    std::ostringstream all;
    all << stream.rdbuf();
    bytes = all.str();
  }
  std::string bytes;
};

template <class T>
bool get(const std::string& file, std::size_t place, T& value) {
  if (place + sizeof(T) > file.size()) return false;
  std::memcpy(&value, file.data() + place, sizeof(T));
  return true;
}

void put_checksum(std::string& file, std::size_t place, std::uint64_t checksum) {
  if (place + sizeof(checksum) <= file.size()) std::memcpy(&file[place], &checksum, sizeof(checksum));
}

/// Walks the file as a reader would, and writes the checksum that each place should have.
void mend_checksums(std::string& file) {
  constexpr std::size_t kFixedBytes = 24;
  std::uint32_t size = 0;
  if (!get(file, 12, size) || kFixedBytes + size > file.size()) return;
  std::uint64_t checksum = foothold::fnv1a(foothold::kFnvBasis, file.data() + kFixedBytes, size);
  put_checksum(file, 16, checksum);
  std::size_t place = kFixedBytes + size + sizeof(std::uint32_t);
  for (int part = 0; part < 2 && get(file, place, size) && place + 4 + size <= file.size(); ++part) {
    checksum = foothold::fnv1a(checksum, file.data() + place + 4, size);
    place += 4 + size;
    while (get(file, place, size) && place + 4 + size <= file.size()) {
      checksum = foothold::fnv1a(checksum, file.data() + place, 4 + size);
      put_checksum(file, place + 4 + size, checksum);
      place += 12 + size;
      if (size == 0) break;
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace foothold;
  std::string file = fuzz::text_of(data, size);
  mend_checksums(file);
  fuzz::attempt([&] {
    Bytes first;
    Bytes second;
    std::istringstream stream(file);
    const SceneDescription description = io::read_scene(stream, "a.scene", {{"first", &first}, {"second", &second}});
    std::ostringstream written;
    io::write_scene(written, description, {{"first", &first}, {"second", &second}});
    Bytes first_again;
    Bytes second_again;
    std::istringstream again(written.str());
    const SceneDescription same = io::read_scene(again, "a.scene", {{"first", &first_again}, {"second", &second_again}});
    fuzz::require(first_again.bytes == first.bytes && second_again.bytes == second.bytes);
    fuzz::require(same.settings.size() == description.settings.size() && same.provenance.size() == description.provenance.size());
  });
  return 0;
}
