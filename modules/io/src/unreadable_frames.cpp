// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "unreadable_frames.h"

#include "exr_header.h"
#include "image_decoding.h"

namespace foothold::io {
namespace {

/// Images within larger files are left to the reader of those.
void check_shape(const StoredImage& image) {
  if (image.coding == ImageCoding::kFile && image.num_bytes == 0) check_image_file(image.file);
  if (image.coding == ImageCoding::kExr) check_exr_file(image.file);
}

}  // namespace

UnreadableFrames::UnreadableFrames(const FoundRecording& found, const Context& context)
    : context_(context), folder_(found.folder.string()), num_frames_(found.frames.size()) {
  std::string first_error;
  for (std::size_t i = 0; i < num_frames_; ++i) {
    try {
      check_shape(found.frames[i].depth);
      check_shape(found.frames[i].colour);
    } catch (const FileError& error) {
      if (frames_.empty()) first_error = error.what();
      frames_.insert(static_cast<int>(i));
    }
  }
  if (frames_.empty()) return;
  const std::string count = std::to_string(frames_.size()) + " of its " + std::to_string(num_frames_) + " frames";
  if (is_refused()) throw FileError(first_error + (frames_.size() > 1 ? "; " + folder_ + ": " + count + " cannot be read" : ""));
  context_.log(LogLevel::kWarning,
               folder_ + ": " + count + " cannot be read, and count as frames without depth; the first: " + first_error);
}

bool UnreadableFrames::contains(int index) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return frames_.count(index) > 0;
}

bool UnreadableFrames::add(int index, const FileError& error) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    frames_.insert(index);
    if (is_refused()) return false;
    if (has_warned_of_damage_) return true;
    has_warned_of_damage_ = true;
  }
  context_.log(LogLevel::kWarning,
               folder_ + ": an image is damaged, and counts as a frame without depth, as any other such: " + std::string(error.what()));
  return true;
}

bool UnreadableFrames::is_refused() const { return frames_.count(0) > 0 || 2 * frames_.size() >= num_frames_; }

}  // namespace foothold::io
