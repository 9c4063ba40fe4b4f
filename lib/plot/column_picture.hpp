#pragma once

#include "lib/csv/csv_table.hpp"
#include "lib/plot/picture.hpp"

#include <span>
#include <string>
#include <vector>

namespace impulse {

struct ColumnSelection {
  std::string x = "time_s";
  std::vector<std::string> y;       ///< none: force_N if the file has it, else every column but x
  std::string pen;                  ///< column at whose changes the line is interrupted; "": none
  std::vector<std::string> labels;  ///< for the legend, of the curves in order; fewer: the rest as usual
};

/// The columns of the tables as curves, with axis labels from their names, time in a readable unit, and legends that
/// tell the curves apart: by file, by column, or both. Those of `marked` are drawn as points.
/// @throws InputError for a column that is missing or not numbers, or a table of one row that is not marked.
/// Verified by: tests/lib/column_picture.test.cpp
[[nodiscard]] Picture column_picture(std::span<const CsvTable> tables, const ColumnSelection& selection,
                                     std::span<const CsvTable> marked = {});

/// Column z over columns x and y, whose rows go through a grid line by line (scan_lines).
/// @throws InputError for a column that is missing or not numbers, or rows that make no grid.
[[nodiscard]] FieldMap column_map(const CsvTable& table, const std::string& x, const std::string& y,
                                  const std::string& z);

}  // namespace impulse
