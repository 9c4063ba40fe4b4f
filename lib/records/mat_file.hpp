#pragma once

#include "lib/records/record.hpp"
#include "lib/records/record_file.hpp"
#include "lib/records/text_record.hpp"

#include <string>
#include <vector>

namespace impulse {

/// Reads the vectors and matrices of a MATLAB file, those in structures and cells too, as channels; the longer side of
/// a matrix runs in time. Times are, of each length: `sampling.step`; a vector called t, time, ...; a scalar called dt,
/// fs, ...; else the first column of a matrix, if it increases. Vectors without times are left out, and said so. Files
/// of write_mat_file come back as they were.
/// @throws InputError for a damaged file, or if no vector has times. Verified by: tests/lib/mat_file.test.cpp
[[nodiscard]] std::vector<Record> read_mat_file(const RecordFile& file, const Sampling& sampling);

[[nodiscard]] bool is_mat_file(std::string_view head);

enum class MatVersion { v5, v73 };

/// Writes a record in SI as a MATLAB file: a vector for the times and one for each channel, under the names of the CSV
/// columns as far as MATLAB allows; `abscissa` and `channels` are structures with start, step, names, units and
/// quantities. Nothing is rounded.
/// @throws OutputError
void write_mat_file(const std::string& path, const Record& record, MatVersion version);

}  // namespace impulse
