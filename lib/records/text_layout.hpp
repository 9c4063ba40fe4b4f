#pragma once

#include "lib/records/text_lines.hpp"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace impulse {

struct TextColumn {
  enum class Role { ignored, abscissa, value };
  Role role = Role::ignored;
  std::string name;
  std::string unit;  ///< as spelled; "" if none is said
};

/// How a text holds a record: everything but its rows.
struct TextLayout {
  std::string format;    ///< in words
  char delimiter = ',';  ///< ' ' stands for any number of blanks and tabs
  char decimal_sign = '.';
  TextPlace begin = {};        ///< at or before the first row
  std::size_t first_line = 1;  ///< of the rows, from 1
  std::size_t last_line = std::numeric_limits<std::size_t>::max();
  std::vector<TextColumn> columns = {};
  std::optional<double> start;  ///< in SI, if the heading says it
  std::optional<double> step;   ///< in SI, > 0, if the heading says it
  std::string step_source;      ///< for messages: `'Sample Interval'`
  std::vector<std::pair<std::string, std::string>> metadata = {};
  std::vector<std::string> notes = {};
};

/// What the user knows better than the file.
struct TextOptions {
  std::optional<char> delimiter;
  std::optional<char> decimal_sign;
  std::optional<std::string> encoding;
  std::optional<std::string> abscissa_column;  ///< name or number from 1; `none`: the record has no time column
};

/// The first lines of a text, in UTF-8.
struct TextHead {
  std::string file;  ///< for messages
  std::vector<std::string> lines = {};
  bool is_whole = true;         ///< no further lines follow
  std::size_t kept = 0;         ///< after so many lines
  std::size_t passed_over = 0;  ///< so many are left out
  std::string encoding = {};    ///< of the file, as iconv calls it

  /// Number in the file, from 1, of lines[i].
  [[nodiscard]] std::size_t number(std::size_t i) const { return i + 1 + (i < kept ? 0 : passed_over); }
};

enum class TextDialect { any, delimited, tektronix, labview, dewesoft, transient, lanl };

/// Finds out how a text holds a record. The rows are the lines at the end in which the same fields are numbers; what
/// stands before them, and in other fields beside them, is names, units and metadata. Of the delimiters tab ; , | and
/// blanks, and the decimal signs, those with most columns of numbers and fewest of text win. A time step is taken from
/// metadata (`Sample Interval`, `Delta_X`, `SampleRate: 5 kHz`, ...). `dialect` other than any must be what the text
/// is.
/// @throws InputError if there are no rows, the dialect is another, or what the heading says is contradictory.
/// Verified by: tests/lib/text_record.test.cpp, tests/tools/ir-convert/
[[nodiscard]] TextLayout text_layout(const TextHead& head, TextDialect dialect, const TextOptions& options);

}  // namespace impulse
