#include "lib/csv/csv_output.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"

#include <csv.h>
#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <cmath>

namespace impulse {
namespace {

// Formatted in place: a back_inserter takes twice as long.
void append_number(std::string& line, double value) {
  std::array<char, 32> digits;
  line.append(digits.data(), fmt::format_to(digits.data(), FMT_COMPILE("{}"), value));
}

/// Quotes only where reading would go wrong without: separators, quotes, outer blanks, and a `#` that reads as a
/// comment.
void append_text(std::string& line, const std::string& text) {
  const bool plain = text.find_first_of(",\"\r\n\t") == text.npos && !text.starts_with('#') && !text.starts_with(' ') &&
                     !text.ends_with(' ');
  if (plain) {
    line += text;
    return;
  }
  std::string quoted(csv_write(nullptr, 0, text.data(), text.size()), '\0');
  csv_write(quoted.data(), quoted.size(), text.data(), text.size());
  line += quoted;
}

std::string header_line(const std::vector<std::string>& names) {
  std::string line;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) line += ',';
    append_text(line, names[i]);
  }
  return line + '\n';
}

void require_finite(const std::string& name, double value) {
  if (!std::isfinite(value)) throw OutputError(fmt::format("column {} is not written: a value is {}", name, value));
}

}  // namespace

void write_csv(const std::string& path, std::span<const NamedColumn> columns) {
  require(!columns.empty(), "a CSV file needs at least one column");
  std::vector<std::string> names;
  const std::size_t row_count = columns.front().values.size();
  for (const NamedColumn& column : columns) {
    require(column.values.size() == row_count, "column {} has {} values, column {} has {}", column.name,
            column.values.size(), columns.front().name, row_count);
    for (const double value : column.values) require_finite(column.name, value);
    names.push_back(column.name);
  }
  OutputFile file(path);
  file.write(header_line(names));
  std::string line;
  for (std::size_t row = 0; row < row_count; ++row) {
    line.clear();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (i > 0) line += ',';
      append_number(line, columns[i].values[row]);
    }
    line += '\n';
    file.write(line);
  }
  file.close();
}

void write_csv(const std::string& path, std::initializer_list<NamedColumn> columns) {
  write_csv(path, std::span<const NamedColumn>(columns.begin(), columns.size()));
}

CsvOutput::CsvOutput(const std::string& path, const std::vector<std::string>& names) : file_(path), names_(names) {
  file_.write(header_line(names));
}

void CsvOutput::row(const std::vector<CsvField>& fields) {
  require(fields.size() == names_.size(), "a row of {} fields for {} columns", fields.size(), names_.size());
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) line += ',';
    if (!fields[i].number_) {
      append_text(line, fields[i].text_);
    } else {
      require_finite(names_[i], *fields[i].number_);
      append_number(line, *fields[i].number_);
    }
  }
  file_.write(line + '\n');
}

void CsvOutput::numbers(std::span<const double> values) {
  require(values.size() == names_.size(), "a row of {} numbers for {} columns", values.size(), names_.size());
  line_.clear();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) line_ += ',';
    require_finite(names_[i], values[i]);
    append_number(line_, values[i]);
  }
  line_ += '\n';
  file_.write(line_);
}

}  // namespace impulse
