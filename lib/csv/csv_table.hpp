#pragma once

#include "lib/series/uniform_series.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace impulse {

/// A CSV file as named columns of text, turned into numbers when a column of numbers is asked for; errors name
/// file:line:column, the column being the number of the field from 1. Not for use by several threads at once.
class CsvTable {
 public:
  /// The numbers of a column; converted at the first call only.
  /// @throws InputError if there is no such column (listing those there are), or at the first field that is empty, not
  /// a number, or not finite.
  [[nodiscard]] const std::vector<double>& column(const std::string& name) const;

  /// One field as text, blanks around it removed. @throws InputError if there is no such column.
  [[nodiscard]] std::string text(const std::string& name, std::size_t row) const;

  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] std::size_t row_count() const { return lines_.size(); }

  /// Line of the file in which a row begins, from 1.
  [[nodiscard]] std::size_t line(std::size_t row) const { return lines_[row]; }

  /// Number of the field of a column, from 1. @throws InputError if there is no such column.
  [[nodiscard]] std::size_t field(const std::string& name) const;

 private:
  friend class CsvReader;
  /// All fields of a column, end to end: one allocation that grows, not one per field.
  struct Text {
    std::string characters;
    std::vector<std::size_t> ends;
    [[nodiscard]] std::string_view row(std::size_t index) const;
  };

  std::string file_;
  std::vector<std::string> names_;
  std::vector<Text> texts_;
  std::vector<std::size_t> lines_;
  mutable std::map<std::size_t, std::vector<double>> numbers_;
};

/// Reads a CSV file (RFC 4180) with one header line, front to back and once, so that a FIFO will do; `-` is stdin.
/// Tolerated: blank lines, lines that begin with `#`, CRLF, a UTF-8 byte order mark, blanks around fields.
/// Memory: about twice the size of the file.
/// @throws InputError if the file cannot be read (saying why), has no header or no row, repeats a name, holds a row
/// with another number of fields than the header, or a quote that is misplaced or left open. Verified by:
/// tests/lib/csv_table.test.cpp
[[nodiscard]] CsvTable read_csv(const std::string& path);

enum class TimeOrigin {
  zero,  ///< the first sample is at 0
  any    ///< a record that began before its trigger
};

/// The grid of column `time_s`: n ≥ 2 samples, starting at 0 or (a record with its own origin) anywhere, step (t_last -
/// t_first)/(n - 1), every interval within 1e-6 of the step. The first sample may be off by 1e-6 step too.
/// @throws InputError at the offending line.
[[nodiscard]] UniformGrid uniform_time(const CsvTable& table, TimeOrigin origin = TimeOrigin::zero);

}  // namespace impulse
