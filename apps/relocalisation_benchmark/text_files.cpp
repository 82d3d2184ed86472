// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <cmath>

#include "foothold/base/angle.h"
#include "foothold/base/number_text.h"
#include "foothold/evaluation/text_table.h"
#include "outputs.h"

namespace foothold::benchmark {
namespace {

void append_pose(const SE3& world_from_camera, std::string& line) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) line += " " + csv_number(world_from_camera.rotation(row, column));
    line += " " + csv_number(world_from_camera.translation(row));
  }
  line += " 0 0 0 1";
}

}  // namespace

std::string percent(double fraction) { return format_number(100.0 * fraction, 1); }

std::string csv_number(double value) {
  if (!std::isfinite(value)) return {};
  return general_text(value, 9);
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_document(const BenchmarkResult& result) {
  std::string csv = "method,sequence,frame,trained,answered,translation_error_m,rotation_error_deg,confidence,accepted,relocalise_ms\n";
  for (const MethodResult& method : result.methods) {
    for (std::size_t i = 0; i < method.log.tests.size(); ++i) {
      const TestRecord& test = method.log.tests[i];
      const double confidence = test.best.has_value() ? test.best->confidence : NAN;
      const bool accepted = test.best.has_value() && test.best->confidence >= method.log.acceptance_threshold;
      csv += csv_cell(method.name) + "," + csv_cell(result.tested[static_cast<std::size_t>(test.input_index)]) + "," +
             std::to_string(test.frame_index) + "," + std::to_string(test.num_trained) + "," + (test.best.has_value() ? "1" : "0") + "," +
             csv_number(test.error.translation_m) + "," + csv_number(test.error.rotation_rad * kDegPerRad) + "," + csv_number(confidence) +
             "," + (accepted ? "1" : "0") + "," + csv_number(method.log.relocalise.wall_ms[i]) + "\n";
    }
  }
  return csv;
}

std::string estimates_document(const BenchmarkResult& result, const MethodResult& method) {
  std::string lines;
  int input_index = -1;
  for (const TestRecord& test : method.log.tests) {
    if (result.tested.size() > 1 && test.input_index != input_index)
      lines += "# " + result.tested[static_cast<std::size_t>(test.input_index)] + "\n";
    input_index = test.input_index;
    std::string line = std::to_string(test.frame_index);
    if (test.best.has_value()) {
      append_pose(test.best->world_from_camera, line);
      line += " " + csv_number(test.best->confidence);
    } else {
      line += " lost";
    }
    lines += line + "\n";
  }
  return lines;
}

}  // namespace foothold::benchmark
