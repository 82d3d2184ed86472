// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "camera_search.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <tuple>
#include <vector>

#include "text_file.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

/// A file that may hold a camera; the least is tried first.
struct Candidate {
  int rank = 0;  ///< of what its name promises
  fs::path file;
  bool certain = false;
  bool must_have_both = false;  ///< its name does not tell the camera that is looked for
  bool operator<(const Candidate& other) const { return std::tie(rank, file) < std::tie(other.rank, other.file); }
};

bool contains(const std::string& text, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return text.find(word) != std::string::npos; });
}

/// A file's name in lower case, '-' for '_', without its extension; empty if it is no kind of text.
std::string plain_stem(const fs::path& file) {
  constexpr std::array<const char*, 5> kExtensions{".txt", ".json", ".csv", ".yaml", ".yml"};
  const std::string extension = file.extension().string();
  if (std::find(kExtensions.begin(), kExtensions.end(), extension) == kExtensions.end()) return {};
  std::string stem = file.stem().string();
  for (char& c : stem) c = c == '_' || c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return stem.substr(std::min(stem.find_first_not_of('-'), stem.size()));
}

std::optional<Candidate> judge(const fs::path& file, CameraKind kind, bool strictly) {
  constexpr std::array<const char*, 10> kAmbiguous{"info",     "camera", "cam",  "k",        "camera-params",
                                                   "metadata", "ost",    "cam0", "camchain", "sensor"};
  const std::string stem = plain_stem(file);
  const bool certain =
      contains(stem, {"intrins", "camera-matrix", "camera-info", "camera-primesense", "cam-params"}) || stem.rfind("calib", 0) == 0;
  const bool ambiguous = std::find(kAmbiguous.begin(), kAmbiguous.end(), stem) != kAmbiguous.end();
  if ((!certain && !ambiguous) || contains(stem, {"extrinsics", "timestamps"})) return std::nullopt;
  const bool names_colour = contains(stem, {"colo", "rgb"});
  const bool names_depth = contains(stem, {"depth"});
  const bool own = kind == CameraKind::kDepth ? names_depth : names_colour;
  const bool other = kind == CameraKind::kDepth ? names_colour : names_depth;
  if (strictly && other) return std::nullopt;
  const int rank = own ? 0 : stem == "camera-intrinsics" ? 1 : ambiguous ? 3 : other ? 4 : 2;
  return Candidate{rank, file, certain, strictly && kind == CameraKind::kColour && !own};
}

std::vector<Candidate> candidates_in(const fs::path& folder, CameraKind kind, bool strictly) {
  std::vector<Candidate> candidates;
  std::error_code ignored;
  for (const fs::path& place :
       {folder, folder / "intrinsic", folder / "intrinsics", folder / "calibration", folder / "calib", folder / "camera"}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(place, ignored)) {
      if (entry.is_directory(ignored)) continue;
      if (const auto candidate = judge(entry.path(), kind, strictly)) candidates.push_back(*candidate);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

}  // namespace

std::optional<FoundCamera> find_camera(const fs::path& folder, CameraKind kind, bool strictly) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  const fs::path parent = (whole.filename().empty() ? whole.parent_path() : whole).parent_path();
  for (const fs::path& place : {folder, parent}) {
    for (const Candidate& candidate : candidates_in(place, kind, strictly)) {
      try {
        const CameraFile content = parse_camera(read_text(candidate.file, kMaxNumbersFileBytes), candidate.file, kind);
        if (content.has_both || !candidate.must_have_both) return FoundCamera{candidate.file, content};
      } catch (const FileError&) {
        if (candidate.certain && !candidate.must_have_both) throw;
      }
    }
  }
  return std::nullopt;
}

}  // namespace foothold::io
