// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/view_warnings.h"

#include <sstream>

#include "common/view_style.h"

namespace foothold::apps {

std::string with_short_paths(const std::string& message) {
  constexpr std::size_t kLong = 32;
  constexpr std::size_t kKept = 28;
  std::istringstream words(message);
  std::string text;
  for (std::string word; words >> word;) {
    if (!text.empty()) text += ' ';
    const std::size_t tail = word.size() > kLong ? word.find('/', word.size() - kKept) : std::string::npos;
    const std::size_t last = word.rfind('/');
    const bool is_path = word.size() > kLong && last != std::string::npos;
    text += is_path ? "..." + word.substr(tail == std::string::npos ? last : tail) : word;
  }
  return text;
}

std::vector<std::string> wrapped(const std::string& message, double height, double max_width) {
  std::vector<std::string> lines(1);
  const auto fits = [&](const std::string& line) { return Canvas::text_width(line, height) <= max_width; };
  std::istringstream words(message);
  for (std::string word; words >> word;) {
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (fits(longer)) {
      lines.back() = longer;
      continue;
    }
    if (!lines.back().empty()) lines.emplace_back();
    for (const char c : word) {
      if (!lines.back().empty() && !fits(lines.back() + c)) lines.emplace_back();
      lines.back() += c;
    }
  }
  return lines;
}

void draw_warnings(Canvas& canvas, const cv::Rect& area, const std::vector<std::string>& warnings) {
  constexpr double kMargin = 14.0;
  constexpr double kRow = 18.0;
  const auto num_rows = static_cast<std::size_t>((area.height - 1.5 * kRow) / kRow);
  canvas.fill_rounded(area, style::kRadius, style::kPanel);
  canvas.fill({area.x, area.y + style::kRadius, 3, area.height - 2 * style::kRadius}, style::kAmber);
  const std::string count = warnings.size() == 1 ? "1 warning" : std::to_string(warnings.size()) + " warnings, the last one first";
  canvas.text({area.x + kMargin, area.y + kRow}, count, style::kBody, style::kAmber);
  std::size_t row = 0;
  for (auto warning = warnings.rbegin(); warning != warnings.rend() && row < num_rows; ++warning) {
    const std::vector<std::string> lines = wrapped(with_short_paths(*warning), style::kLabel, area.width - 2.0 * kMargin);
    for (std::size_t i = 0; i < lines.size() && row < num_rows; ++i, ++row) {
      const bool is_cut = row + 1 == num_rows && i + 1 < lines.size();
      const double width = area.width - 2.0 * kMargin;
      canvas.text({area.x + kMargin, area.y + kRow * (2.0 + static_cast<double>(row))},
                  is_cut ? Canvas::shortened(lines[i] + " " + lines[i + 1], style::kLabel, width) : lines[i], style::kLabel,
                  i == 0 ? style::kText : style::kDimText);
    }
  }
}

}  // namespace foothold::apps
