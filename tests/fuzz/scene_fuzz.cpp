// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Scene files: what is accepted reads the same once written again. Checksums are set right first, or no input would get past them.
#include "foothold/files/scene_file.h"

#include <sstream>

#include "fuzz.h"
#include "support/mend_checksums.h"

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

/// A scene's head and its parts, each chained to what came before.
void mend_checksums(std::string& file) {
  std::size_t place = 0;
  std::uint64_t chain = foothold::kFnvBasis;
  while (place < file.size()) chain = foothold::test::mend_checksums(file, place, chain);
}

}  // namespace

FOOTHOLD_FUZZ_TARGET(scene) {
  using namespace foothold;
  std::string file = fuzz::text_of(data, size);
  mend_checksums(file);
  fuzz::attempt([&] {
    Bytes first;
    Bytes second;
    std::istringstream stream(file);
    const SceneDescription description = read_scene(stream, "a.scene", {{"first", &first}, {"second", &second}});
    std::ostringstream written;
    write_scene(written, description, {{"first", &first}, {"second", &second}});
    Bytes first_again;
    Bytes second_again;
    std::istringstream again(written.str());
    const SceneDescription same = read_scene(again, "a.scene", {{"first", &first_again}, {"second", &second_again}});
    fuzz::require(first_again.bytes == first.bytes && second_again.bytes == second.bytes);
    fuzz::require(same.settings.size() == description.settings.size() && same.provenance.size() == description.provenance.size());
  });
  return 0;
}
