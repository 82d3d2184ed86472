// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/text_table.h"

#include <algorithm>
#include <cmath>

#include "foothold/base/contract.h"
#include "foothold/base/number_text.h"

namespace foothold {
namespace {

std::string format_row(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) {
  std::string line = "|";
  for (std::size_t column = 0; column < cells.size(); ++column) {
    const std::string padding(widths[column] - cells[column].size(), ' ');
    line += column == 0 ? " " + cells[column] + padding + " |" : " " + padding + cells[column] + " |";
  }
  return line + "\n";
}

}  // namespace

std::string format_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const std::string& cell : header) widths.push_back(std::max<std::size_t>(cell.size(), 3));
  for (const std::vector<std::string>& row : rows) {
    FOOTHOLD_EXPECTS(row.size() == header.size());
    for (std::size_t column = 0; column < row.size(); ++column) widths[column] = std::max(widths[column], row[column].size());
  }
  std::string table = format_row(header, widths) + "|";
  for (std::size_t column = 0; column < widths.size(); ++column) {
    table += column == 0 ? std::string(widths[column] + 2, '-') + "|" : std::string(widths[column] + 1, '-') + ":|";
  }
  table += "\n";
  for (const std::vector<std::string>& row : rows) table += format_row(row, widths);
  return table;
}

std::string format_number(double value, int num_decimals) {
  if (!std::isfinite(value)) return "-";
  return fixed_text(value, num_decimals);
}

}  // namespace foothold
