#pragma once

#include "lib/csv/output_file.hpp"

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>
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

/// A field of a row that mixes text and numbers. Empty by default and for a std::optional without value.
class CsvField {
 public:
  CsvField() = default;
  CsvField(std::string text) : text_(std::move(text)) {}  // NOLINT(google-explicit-constructor): rows read as lists
  CsvField(const char* text) : text_(text) {}             // NOLINT(google-explicit-constructor)
  CsvField(double number) : number_(number) {}            // NOLINT(google-explicit-constructor)
  CsvField(std::optional<double> number) : number_(number) {}  // NOLINT(google-explicit-constructor)

 private:
  friend class CsvOutput;
  std::string text_;
  std::optional<double> number_;
};

/// Writes a CSV of mixed rows one by one; nothing appears under `path` before close().
class CsvOutput {
 public:
  CsvOutput(const std::string& path, const std::vector<std::string>& names);

  /// @throws std::invalid_argument if the number of fields is not that of the names; OutputError for a number that is
  /// not finite; as OutputFile::write.
  void row(const std::vector<CsvField>& fields);
  /// A row of numbers alone, without an allocation. @throws as row().
  void numbers(std::span<const double> values);
  void close() { file_.close(); }

 private:
  OutputFile file_;
  std::vector<std::string> names_;
  std::string line_;
};

}  // namespace impulse
