#pragma once

#include "lib/records/text_record.hpp"
#include "lib/records/universal_file.hpp"

#include <string>
#include <utility>
#include <vector>

namespace impulse {

enum class RecordFormat { automatic, delimited, tektronix, labview, dewesoft, transient, lanl, universal, matlab, wav };

struct ReadOptions {
  RecordFormat format = RecordFormat::automatic;
  TextOptions text;
  Sampling sampling;
  BinaryOptions binary;
};

/// Reads a record of any format that is known; channels with different abscissas come as several records.
/// `file` must outlive them. @throws InputError for what is wrong in the file, with the line or byte; UsageError for an
/// option that its format has no use for. Verified by: tests/tools/ir-convert/
[[nodiscard]] std::vector<std::unique_ptr<RecordRows>> read_records(const RecordFile& file, const ReadOptions& options);

}  // namespace impulse
