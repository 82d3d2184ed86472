// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "exr_image.h"

#ifdef FOOTHOLD_HAS_EXR
#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#endif

#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "exr_header.h"
#include "text_file.h"

namespace foothold::io {

namespace fs = std::filesystem;

#ifdef FOOTHOLD_HAS_EXR

namespace {

void put(std::string& bytes, const void* value, std::size_t count) { bytes.append(static_cast<const char*>(value), count); }

void put_attribute(std::string& bytes, std::string_view name, std::string_view type, std::string_view value) {
  bytes.append(name).append(1, '\0').append(type).append(1, '\0');
  const auto size = static_cast<std::int32_t>(value.size());
  put(bytes, &size, sizeof size);
  bytes.append(value);
}

/// The same image with a header of only what is needed, so that a decoder cannot understand it otherwise: OpenEXR passes over the sizes of
/// attributes that it knows.
std::string with_plain_header(const std::string& bytes, const ExrHeader& header) {
  const auto text_of = [](const auto& value) { return std::string_view(reinterpret_cast<const char*>(&value), sizeof value); };
  std::string plain = bytes.substr(0, 8);  // signature and version
  put_attribute(plain, "channels", "chlist", header.channels);
  put_attribute(plain, "compression", "compression", text_of(header.compression));
  put_attribute(plain, "dataWindow", "box2i", text_of(header.window));
  put_attribute(plain, "displayWindow", "box2i", text_of(header.window));
  put_attribute(plain, "lineOrder", "lineOrder", text_of(char{0}));
  put_attribute(plain, "pixelAspectRatio", "float", text_of(1.0F));
  put_attribute(plain, "screenWindowCenter", "v2f", text_of(std::array<float, 2>{}));
  put_attribute(plain, "screenWindowWidth", "float", text_of(1.0F));
  plain += '\0';
  const std::uint64_t size = plain.size();
  for (std::size_t i = 0; i < header.num_chunks; ++i) {
    std::uint64_t place = 0;
    std::memcpy(&place, bytes.data() + header.num_bytes + i * sizeof place, sizeof place);
    place = place - header.num_bytes + size;
    put(plain, &place, sizeof place);
  }
  return plain + bytes.substr(header.num_bytes + header.num_chunks * sizeof(std::uint64_t));
}

/// Bytes in memory, as OpenEXR reads them.
class MemoryStream : public Imf::IStream {
 public:
  MemoryStream(const std::string& bytes, const std::string& name) : Imf::IStream(name.c_str()), bytes_(bytes) {}

  bool read(char* target, int count) override {
    if (count < 0 || static_cast<std::uint64_t>(count) > bytes_.size() - at_) throw Iex::InputExc("unexpected end of file");
    std::memcpy(target, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::uint64_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override {
    if (position > bytes_.size()) throw Iex::InputExc("a place beyond the end of file");
    at_ = position;
  }

 private:
  const std::string& bytes_;
  std::uint64_t at_ = 0;
};

}  // namespace

bool reads_exr() { return true; }

Image<float> decode_exr(const std::string& bytes, const fs::path& name) {
  const ExrHeader header = parse_exr_head(bytes, bytes.size(), name);
  Image<float> image(header.size.width, header.size.height);
  try {
    const std::string plain = with_plain_header(bytes, header);
    MemoryStream stream(plain, name.string());
    Imf::InputFile file(stream, 0);  // without threads of its own
    const Imath::Box2i window({header.window[0], header.window[1]}, {header.window[2], header.window[3]});
    Imf::FrameBuffer buffer;
    buffer.insert(header.channel, Imf::Slice::Make(Imf::FLOAT, image.data(), window));
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
  } catch (const Iex::BaseExc& error) {
    throw_file_error(name, "an EXR image that cannot be decoded (" + std::string(error.what()) + ")", "a complete EXR image");
  }
  return image;
}

#else

bool reads_exr() { return false; }

Image<float> decode_exr(const std::string& bytes, const fs::path& name) {
  throw_file_error(name, "an EXR image of " + std::to_string(bytes.size()) + " bytes", "a build of Foothold with OpenEXR");
}

#endif

}  // namespace foothold::io
