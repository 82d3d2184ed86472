// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "text_file.h"
#include "tum_sequence.h"

namespace foothold::io {
namespace {

StampedFile parse_stamped_file(const TextLine& line, std::size_t column, const std::filesystem::path& file) {
  const std::string where = "line " + std::to_string(line.number);
  StampedFile image{parse_number(line.words[column], file, "the time in " + where), std::string(line.words[column + 1])};
  std::replace(image.name.begin(), image.name.end(), '\\', '/');  // as Windows separates folders
  const std::filesystem::path path = image.name;
  const bool leads_out = path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end();
  if (leads_out) throw_file_error(file, in_quotes(image.name) + " in " + where, "an image in the folder of this list");
  return image;
}

bool earlier(const StampedFile& a, const StampedFile& b) { return a.timestamp_s < b.timestamp_s; }
bool same(const StampedFile& a, const StampedFile& b) { return a.timestamp_s == b.timestamp_s && a.name == b.name; }

}  // namespace

std::vector<StampedFile> parse_image_list(std::string_view text, const std::filesystem::path& file) {
  std::vector<StampedFile> images;
  for (const TextLine& line : split_lines(text)) {
    if (line.words.size() != 2) {
      throw_file_error(file, std::to_string(line.words.size()) + " words in line " + std::to_string(line.number), "2: timestamp filename");
    }
    images.push_back(parse_stamped_file(line, 0, file));
  }
  if (images.empty()) throw_file_error(file, "no image", "lines of timestamp filename");
  std::stable_sort(images.begin(), images.end(), earlier);
  images.erase(std::unique(images.begin(), images.end(), same), images.end());
  return images;
}

std::vector<ImagePair> parse_associations(std::string_view text, const std::filesystem::path& file) {
  constexpr const char* kExpected = "4: timestamp depth/NAME.png timestamp rgb/NAME.png";
  std::vector<ImagePair> pairs;
  for (const TextLine& line : split_lines(text)) {
    const std::string where = " in line " + std::to_string(line.number);
    if (line.words.size() != 4) throw_file_error(file, std::to_string(line.words.size()) + " words" + where, kExpected);
    ImagePair pair{parse_stamped_file(line, 0, file), parse_stamped_file(line, 2, file)};
    if (pair.colour.name.rfind("depth", 0) == 0) std::swap(pair.depth, pair.colour);
    if (pair.depth.name.rfind("depth", 0) != 0) throw_file_error(file, "no image in a folder named depth" + where, kExpected);
    pairs.push_back(std::move(pair));
  }
  if (pairs.empty()) throw_file_error(file, "no image", "lines of timestamp depth/NAME.png timestamp rgb/NAME.png");
  std::stable_sort(pairs.begin(), pairs.end(), [](const ImagePair& a, const ImagePair& b) { return earlier(a.depth, b.depth); });
  const auto same_pair = [](const ImagePair& a, const ImagePair& b) { return same(a.depth, b.depth) && same(a.colour, b.colour); };
  pairs.erase(std::unique(pairs.begin(), pairs.end(), same_pair), pairs.end());
  return pairs;
}

std::vector<ImagePair> associate(const std::vector<StampedFile>& depth, const std::vector<StampedFile>& colour, double max_difference_s) {
  struct Candidate {
    double difference_s;
    std::size_t depth;
    std::size_t colour;
  };
  std::vector<Candidate> candidates;
  std::size_t first = 0;
  for (std::size_t d = 0; d < depth.size(); ++d) {
    while (first < colour.size() && colour[first].timestamp_s < depth[d].timestamp_s - max_difference_s) ++first;
    for (std::size_t c = first; c < colour.size() && colour[c].timestamp_s <= depth[d].timestamp_s + max_difference_s; ++c) {
      candidates.push_back({std::abs(colour[c].timestamp_s - depth[d].timestamp_s), d, c});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.difference_s < b.difference_s; });

  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> partner(depth.size(), kNone);
  std::vector<bool> taken(colour.size(), false);
  for (const Candidate& candidate : candidates) {
    if (partner[candidate.depth] != kNone || taken[candidate.colour]) continue;
    partner[candidate.depth] = candidate.colour;
    taken[candidate.colour] = true;
  }
  std::vector<ImagePair> pairs;
  for (std::size_t d = 0; d < depth.size(); ++d) {
    if (partner[d] != kNone) pairs.push_back({depth[d], colour[partner[d]]});
  }
  return pairs;
}

std::pair<std::size_t, std::size_t> nearest_pair(const std::vector<StampedFile>& depth, const std::vector<StampedFile>& colour) {
  std::pair<std::size_t, std::size_t> nearest{0, 0};
  const auto apart_s = [&](std::size_t d, std::size_t c) { return std::abs(depth[d].timestamp_s - colour[c].timestamp_s); };
  for (std::size_t d = 0, c = 0; d < depth.size(); ++d) {
    while (c + 1 < colour.size() && apart_s(d, c + 1) <= apart_s(d, c)) ++c;
    if (apart_s(d, c) < apart_s(nearest.first, nearest.second)) nearest = {d, c};
  }
  return nearest;
}

std::string time_text(double time_s) {
  std::array<char, 340> text{};
  std::snprintf(text.data(), text.size(), "%.6f", time_s);
  return text.data();
}

}  // namespace foothold::io
