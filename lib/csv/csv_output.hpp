#pragma once

#include "lib/csv/output_file.hpp"

#include <initializer_list>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace impulse {

/// A column to be written; the values must outlive it.
struct NamedColumn {
  std::string name;
  std::span<const double> values;
};

/// Writes columns of numbers as CSV (RFC 4180, LF, shortest digits that read back the same, whatever the locale).
/// Path and errors as OutputFile.
/// @throws std::invalid_argument if the columns differ in length; OutputError, before anything is written, if a value
/// is not finite. Verified by: tests/lib/csv_output.test.cpp
void write_csv(const std::string& path, std::span<const NamedColumn> columns);
void write_csv(const std::string& path, std::initializer_list<NamedColumn> columns);

/// A field of a row that mixes text and numbers; std::monostate is an empty field.
using CsvField = std::variant<std::monostate, std::string, double>;

/// Writes a CSV of mixed rows one by one; nothing appears under `path` before close().
class CsvOutput {
 public:
  CsvOutput(const std::string& path, const std::vector<std::string>& names);

  /// @throws std::invalid_argument if the number of fields is not that of the names; OutputError for a number that is
  /// not finite; as OutputFile::write.
  void row(const std::vector<CsvField>& fields);
  void close() { file_.close(); }

 private:
  OutputFile file_;
  std::vector<std::string> names_;
};

}  // namespace impulse
