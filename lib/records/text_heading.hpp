#pragma once

#include "lib/records/record_file.hpp"
#include "lib/records/text_layout.hpp"

#include <vector>

namespace impulse {

/// How a text file holds its records (text_layout), from its first lines: one, or one for each segment of a LabVIEW
/// measurement, which has a heading, columns and times of its own. Headings are looked for in the first 4 MiB; segments
/// in one pass over the file.
/// @throws InputError as text_layout, and for an empty file, UTF-16 or bytes that are no text.
/// Verified by: tests/lib/text_record.test.cpp, tests/tools/ir-convert/
[[nodiscard]] std::vector<TextLayout> text_layouts(const RecordFile& file, TextDialect dialect,
                                                   const TextOptions& options);

}  // namespace impulse
