#pragma once

#include "lib/records/record.hpp"

#include <string>
#include <vector>

namespace impulse {

/// The columns of a record in SI: abscissa (`time_s`), then every channel under its name and unit, a complex one as
/// `..._real` and
/// `..._imaginary` before the unit.
[[nodiscard]] std::vector<std::string> record_columns(const RecordHeader& header);

/// Writes a record in SI as CSV, row by row. Path and errors as CsvOutput.
/// Verified by: tests/tools/ir-convert/
void write_record_csv(const std::string& path, RecordRows& rows);

}  // namespace impulse
