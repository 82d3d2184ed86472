// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/io/sequence.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>

#include "folder_recording.h"
#include "foothold/base/contract.h"
#include "foothold/io/recording.h"
#include "foothold/synthetic/synthetic_sequence.h"
#include "record3d_sequence.h"
#include "sens_file.h"
#include "text_file.h"

namespace foothold {
namespace {

namespace fs = std::filesystem;

/// A part of another sequence.
class SequencePart : public Sequence {
 public:
  SequencePart(std::shared_ptr<Sequence> whole, int begin, int end) : whole_(std::move(whole)), begin_(begin), end_(end) {}
  std::string name() const override { return whole_->name() + "@" + std::to_string(begin_) + ":" + std::to_string(end_); }
  int num_frames() const override { return end_ - begin_; }
  RgbdFrame load(int index) const override {
    FOOTHOLD_EXPECTS(index >= 0 && index < num_frames());
    return whole_->load(begin_ + index);
  }
  Eigen::Vector3d origin_m() const override { return whole_->origin_m(); }

 private:
  std::shared_ptr<Sequence> whole_;
  int begin_;
  int end_;
};

std::shared_ptr<Sequence> take_part(std::shared_ptr<Sequence> whole, const FrameRange& range) {
  const int num_frames = whole->num_frames();
  const int end = range.end == FrameRange::kToTheEnd ? num_frames : range.end;
  if (range.begin >= end || end > num_frames) {
    throw InvalidSettings("frame range " + std::to_string(range.begin) + ":" + std::to_string(end) + " of " + whole->name() +
                          ": expected a non-empty part of its " + std::to_string(num_frames) + " frames, 0:" + std::to_string(num_frames));
  }
  return std::make_shared<SequencePart>(std::move(whole), range.begin, end);
}

/// The first few names of what is in a folder.
std::string contents_of(const fs::path& folder) {
  constexpr std::size_t kMaxNames = 6;
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string() + (entry.is_directory() ? "/" : ""));
  }
  std::sort(names.begin(), names.end());
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMaxNames); ++i) text += (i == 0 ? "" : ", ") + names[i];
  return names.size() > kMaxNames ? text + " and " + std::to_string(names.size() - kMaxNames) + " more" : text;
}

[[noreturn]] void throw_unknown_folder(const fs::path& folder) {
  if (fs::is_empty(folder)) throw FileError(folder.string() + ": got an empty folder, expected a recording");
  if (fs::exists(folder / "TrainSplit.txt") || fs::exists(folder / "seq-01")) {
    throw FileError(folder.string() + ": got the folder of a 7-Scenes scene, expected one of its sequences, such as " +
                    (folder / "seq-01").string());
  }
  std::string known;
  for (const io::Layout& layout : io::layouts()) known += std::string("\n  ") + layout.name + ": " + layout.description;
  throw FileError(folder.string() + ": got a folder of another kind, with " + contents_of(folder) +
                  "; expected a recording in one of these layouts:" + known);
}

std::shared_ptr<Sequence> open_whole(const std::string& source, const Context& context, const SequenceOptions& options) {
  if (source.empty()) throw InvalidSettings("sequence: got an empty name, expected a recording's folder or synthetic:NAME");
  if (is_synthetic_spec(source)) return make_synthetic_sequence(parse_synthetic_spec(source), context);
  return open_recording(source, context, options);
}

/// The position of the '@' that begins a range, or npos. Folders may have an '@' in their names.
std::size_t find_range(const std::string& spec) {
  const std::size_t at = spec.rfind('@');
  if (at == std::string::npos) return at;
  const std::string suffix = spec.substr(at + 1);
  const bool is_range = suffix.find(':') != std::string::npos && suffix.find_first_not_of("0123456789:-") == std::string::npos;
  return is_range ? at : std::string::npos;
}

}  // namespace

FrameRange parse_frame_range(const std::string& text) {
  const auto fail = [&]() -> FrameRange {
    throw InvalidSettings("frame range: got " + in_quotes(text) +
                          ", expected A:B with 0 <= A < B, the last one excluded; either may be left out");
  };
  const auto parse = [&](std::string_view digits, int fallback) {
    if (digits.empty()) return fallback;
    int value = -1;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || value < 0) fail();
    return value;
  };
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return fail();
  const std::string_view view = text;
  const FrameRange range{parse(view.substr(0, colon), 0), parse(view.substr(colon + 1), FrameRange::kToTheEnd)};
  return range.begin < range.end ? range : fail();
}

std::shared_ptr<Recording> open_recording(const std::string& source, const Context& context, const SequenceOptions& options) {
  const fs::path folder = source;
  try {
    if (!fs::exists(folder)) throw FileError(source + ": no such folder; expected a recording's folder or synthetic:NAME");
    if (fs::is_regular_file(folder) && folder.extension() == ".sens")
      return io::make_recording(io::read_sens_file(folder, context), context, options);
    if (const std::string archive = io::describe_record3d_archive(folder); !archive.empty()) throw FileError(archive);
    if (!fs::is_directory(folder)) throw_file_error(folder, "a file", "a recording's folder");
    for (const io::Layout& layout : io::layouts()) {
      if (layout.matches(folder)) return io::make_recording(layout.read(folder, context), context, options);
    }
    throw_unknown_folder(folder);
  } catch (const fs::filesystem_error& error) {
    throw FileError(source + ": " + error.code().message());
  }
}

std::shared_ptr<Sequence> open_sequence(const std::string& spec, const Context& context, const SequenceOptions& options) {
  const std::size_t at = find_range(spec);
  if (at == std::string::npos) return open_whole(spec, context, options);
  const FrameRange range = parse_frame_range(spec.substr(at + 1));
  return take_part(open_whole(spec.substr(0, at), context, options), range);
}

}  // namespace foothold
