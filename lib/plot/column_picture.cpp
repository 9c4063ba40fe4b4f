#include "lib/plot/column_picture.hpp"

#include "lib/contract/errors.hpp"
#include "lib/plot/axis_label.hpp"
#include "lib/plot/scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>

namespace impulse {
namespace {

std::vector<std::string> chosen_columns(const CsvTable& table, const ColumnSelection& selection) {
  if (!selection.y.empty()) return selection.y;
  if (table.has("force_N") && selection.x != "force_N") return {"force_N"};
  std::vector<std::string> columns = table.names();
  std::erase(columns, selection.x);
  if (columns.empty()) throw InputError(table.file(), 0, 0, "no column to draw besides '" + selection.x + "'");
  return columns;
}

/// Names of the files without their folders where that still tells them apart.
std::vector<std::string> file_labels(std::span<const CsvTable> tables) {
  std::vector<std::string> labels;
  for (const CsvTable& table : tables) labels.push_back(std::filesystem::path(table.file()).filename().string());
  if (std::set<std::string>(labels.begin(), labels.end()).size() == labels.size()) return labels;
  labels.clear();
  for (const CsvTable& table : tables) labels.push_back(table.file());
  return labels;
}

void append_once(std::vector<std::string>& texts, const std::string& text) {
  if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(text);
}

std::string joined(const std::vector<std::string>& texts) {
  std::string result;
  for (const std::string& text : texts) result += (result.empty() ? "" : ", ") + text;
  return result;
}

/// `velocity 1, velocity 2 (m/s)` where the unit is common, else every quantity with its own.
Axis common_axis(const std::vector<std::string>& columns) {
  std::vector<std::string> quantities, units, labels;
  for (const std::string& column : columns) {
    const ColumnMeaning meaning = column_meaning(column);
    append_once(quantities, meaning.quantity);
    append_once(units, meaning.unit);
    append_once(labels, axis_label(meaning));
  }
  Axis axis;
  axis.label = units.size() == 1 ? axis_label({joined(quantities), units.front()}) : joined(labels);
  if (units.size() == 1) axis.si_unit = units.front();
  return axis;
}

double largest(std::span<const CsvTable> tables, const std::string& column) {
  double result = 0;
  for (const CsvTable& table : tables)
    for (const double value : table.column(column)) result = std::max(result, std::abs(value));
  return result;
}

std::vector<std::size_t> pen_lifts(const CsvTable& table, const std::string& column) {
  std::vector<std::size_t> lifts;
  if (column.empty()) return lifts;
  const std::vector<double>& values = table.column(column);
  for (std::size_t row = 1; row < values.size(); ++row)
    if (values[row] != values[row - 1]) lifts.push_back(row);
  return lifts;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

/// Of a column; time in the unit that reads best.
Axis column_axis(std::span<const CsvTable> tables, const std::string& column) {
  ColumnMeaning meaning = column_meaning(column);
  Axis axis;
  axis.si_unit = meaning.unit;
  if (meaning.unit == "s") {
    const ScaledUnit unit = readable_time_unit(largest(tables, column));
    meaning.unit = unit.unit;
    axis.per_si = unit.per_si;
  }
  axis.label = axis_label(meaning);
  return axis;
}

}  // namespace

Picture column_picture(std::span<const CsvTable> tables, const ColumnSelection& selection,
                       std::span<const CsvTable> marked) {
  std::vector<CsvTable> all(tables.begin(), tables.end());
  all.insert(all.end(), marked.begin(), marked.end());
  const Axis x_axis = column_axis(all, selection.x);
  const std::vector<std::string> files = file_labels(all);
  Picture picture;
  std::vector<std::string> columns;
  for (const CsvTable& table : all)
    for (const std::string& column : chosen_columns(table, selection)) append_once(columns, column);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const CsvTable& table = all[i];
    const Mark mark = i < tables.size() ? Mark::line : Mark::points;
    if (mark == Mark::line && table.row_count() < 2)
      throw InputError(table.file(), table.line(0), 0, "one row only (a curve needs two)");
    for (const std::string& column : chosen_columns(table, selection)) {
      const std::string quantity = column_meaning(column).quantity;
      std::string label = all.size() > 1 ? files[i] : quantity;
      if (all.size() > 1 && columns.size() > 1) label += ": " + quantity;
      if (picture.curves.size() < selection.labels.size()) label = selection.labels[picture.curves.size()];
      picture.curves.push_back({label, scaled(table.column(selection.x), x_axis.per_si), table.column(column), mark,
                                pen_lifts(table, selection.pen)});
    }
  }
  if (selection.labels.size() > picture.curves.size())
    throw UsageError("--label",
                     fmt::format("given {} times for {} curves", selection.labels.size(), picture.curves.size()));
  picture.frame.x = x_axis;
  picture.frame.y = common_axis(columns);
  return picture;
}

FieldMap column_map(const CsvTable& table, const std::string& x, const std::string& y, const std::string& z) {
  const std::vector<double>&xs = table.column(x), &ys = table.column(y), &zs = table.column(z);
  std::vector<ScanPoint> points;
  for (std::size_t row = 0; row < xs.size(); ++row) points.push_back({xs[row], ys[row], zs[row]});
  FieldMap map;
  map.scans = scan_lines(points);
  std::size_t row = 0;
  for (const auto& scan : map.scans) {
    if (map.scans.size() < 2 || scan.size() < 2 || scan.size() != map.scans.front().size())
      throw InputError(table.file(), table.line(row), 0,
                       fmt::format("the rows make no grid: a line of it ({} against {}) has {} points, the first {}", x,
                                   y, scan.size(), map.scans.front().size()));
    row += scan.size();
  }
  map.frame.x = common_axis({x});
  map.frame.y = common_axis({y});
  map.z_label = axis_label(column_meaning(z));
  return map;
}

}  // namespace impulse
