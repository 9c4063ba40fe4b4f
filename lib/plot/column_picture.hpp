#pragma once

#include "lib/csv/csv_table.hpp"
#include "lib/plot/gnuplot.hpp"

#include <span>
#include <string>
#include <vector>

namespace impulse {

struct ColumnSelection {
  std::string x = "time_s";
  std::vector<std::string> y;  ///< none: force_N if the file has it, else every column but x
};

/// The columns of the tables as curves, with axis labels from their names, time in a readable unit, and legends that
/// tell the curves apart: by file, by column, or both.
/// @throws InputError for a column that is missing or not numbers, or a table of one row.
/// Verified by: tests/lib/column_picture.test.cpp
[[nodiscard]] Picture column_picture(std::span<const CsvTable> tables, const ColumnSelection& selection);

}  // namespace impulse
