#include "lib/plot/column_picture.hpp"

#include "lib/contract/errors.hpp"
#include "lib/plot/axis_label.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
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
std::string common_label(const std::vector<std::string>& columns) {
  std::vector<std::string> quantities, units, labels;
  for (const std::string& column : columns) {
    const ColumnMeaning meaning = column_meaning(column);
    append_once(quantities, meaning.quantity);
    append_once(units, meaning.unit);
    append_once(labels, axis_label(meaning));
  }
  return units.size() == 1 ? axis_label({joined(quantities), units.front()}) : joined(labels);
}

double largest(std::span<const CsvTable> tables, const std::string& column) {
  double result = 0;
  for (const CsvTable& table : tables)
    for (const double value : table.column(column)) result = std::max(result, std::abs(value));
  return result;
}

}  // namespace

Picture column_picture(std::span<const CsvTable> tables, const ColumnSelection& selection) {
  ColumnMeaning x_meaning = column_meaning(selection.x);
  double x_factor = 1;
  if (x_meaning.unit == "s") {
    const ScaledUnit unit = readable_time_unit(largest(tables, selection.x));
    x_meaning.unit = unit.unit;
    x_factor = unit.per_si;
  }
  const std::vector<std::string> files = file_labels(tables);
  Picture picture;
  std::vector<std::string> all_columns;
  for (const CsvTable& table : tables)
    for (const std::string& column : chosen_columns(table, selection)) append_once(all_columns, column);
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const CsvTable& table = tables[i];
    if (table.row_count() < 2) throw InputError(table.file(), table.line(0), 0, "one row only (a curve needs two)");
    std::vector<double> x = table.column(selection.x);
    for (double& value : x) value *= x_factor;
    for (const std::string& column : chosen_columns(table, selection)) {
      const std::string quantity = column_meaning(column).quantity;
      std::string label = tables.size() > 1 ? files[i] : quantity;
      if (tables.size() > 1 && all_columns.size() > 1) label += ": " + quantity;
      picture.curves.push_back({label, x, table.column(column)});
    }
  }
  picture.x_label = axis_label(x_meaning);
  picture.y_label = common_label(all_columns);
  return picture;
}

}  // namespace impulse
