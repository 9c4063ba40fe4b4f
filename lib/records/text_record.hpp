#pragma once

#include "lib/records/record.hpp"
#include "lib/records/record_file.hpp"
#include "lib/records/text_layout.hpp"

#include <memory>
#include <optional>

namespace impulse {

/// Sampling that the user knows, in SI.
struct Sampling {
  std::optional<double> step;
  std::optional<double> start;
};

/// Reads a text that holds a record (text_layout), or several (segments of a LabVIEW measurement), in constant memory
/// and twice over the file: once for its times, once for its rows.
///
/// The time step is `sampling.step`, else that of the heading, else found from the time column (EvenTimeFit): from its
/// digits as they are, then taking them for cut off, then for noise of a thousandth of a step, then for single
/// precision. What was done is in the header's notes. A time column that no even step explains stays uneven. A last row
/// that breaks off is left out, and said so. Empty lines and lines that begin with `#` don't count. `file` must outlive
/// the rows.
/// @throws InputError at file:line:field for a row that isn't one, a time that does not increase, a heading that
/// contradicts the times, no time at all, or bytes that are no text. Verified by: tests/lib/text_record.test.cpp
[[nodiscard]] std::vector<std::unique_ptr<RecordRows>> read_text_records(const RecordFile& file, TextDialect dialect,
                                                                         const TextOptions& options,
                                                                         const Sampling& sampling);

}  // namespace impulse
