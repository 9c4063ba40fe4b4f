#pragma once

#include "lib/records/record.hpp"
#include "lib/records/record_file.hpp"

#include <optional>
#include <string>
#include <vector>

namespace impulse {

enum class ByteOrder { little, big };

/// What to do with a record that breaks off.
enum class Incomplete { refuse, take };

struct BinaryOptions {
  Incomplete incomplete = Incomplete::refuse;
  std::optional<ByteOrder> byte_order;  ///< instead of what the file says
};

/// Reads the functions of a universal file: datasets 58 (text) and 58b (binary, IEEE), real or complex, single or
/// double precision, even or uneven abscissa, LF or CRLF. Datasets with one abscissa make one record; others than 58,
/// 58b and 164 are left out.
///
/// Numbers of a text may follow each other without blanks (-1.0E+00-2.0E+00), have exponents of three digits, with D or
/// without a letter; the last line need not be full. Binary values may have a stray line end before or behind them. A
/// channel is named after its response's entity, else its label or node, else its first line; its unit is that of the
/// axis label (numerator over denominator), else, with a dataset 164, SI: values are divided by its factors of length
/// and force, raised to the exponents of the axis.
/// @throws InputError with the line (text) or byte (binary) for a file that breaks off, ends too late, holds what is no
/// number, or whose values make sense only in the other byte order. Verified by: tests/lib/universal_file.test.cpp
[[nodiscard]] std::vector<Record> read_universal_file(const RecordFile& file, const BinaryOptions& options);

/// Whether a file begins like a universal one.
[[nodiscard]] bool is_universal_file(std::string_view head);

enum class UniversalForm { text, binary };

/// Writes each channel of a record in SI as a dataset 58 or 58b in double precision, with its name in the first line. A
/// text has 13 digits of a value and 6 of an uneven abscissa, as the format wants it; binary everything. The format has
/// 6 digits for start and step: all of them stand in the fourth line, where read_universal_file finds them.
void write_universal_file(const std::string& path, const Record& record, UniversalForm form);

}  // namespace impulse
