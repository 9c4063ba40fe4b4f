#pragma once

#include "lib/records/record_file.hpp"

#include <string>
#include <vector>

namespace impulse {

/// A numeric matrix or a text of a MATLAB file; a member of a structure is called `s.member` or `s(2).member`, of a
/// cell `c{2}`.
struct MatArray {
  std::string name;
  std::size_t rows = 0, columns = 0;
  bool is_complex = false;
  bool is_text = false;
  std::string text;                     ///< UTF-8
  std::vector<double> real, imaginary;  ///< column by column, as MATLAB has them

  [[nodiscard]] bool is_scalar() const { return !is_text && rows == 1 && columns == 1; }
};

/// All matrices and texts of a MATLAB file of version 4, 5 or 7.3, as matio reads them.
///
/// matio and HDF5 trust what a file says of itself: damaged files make them crash. They therefore run in a process of
/// their own that can take nothing with it; its memory and its time are limited to what the file could unpack to.
/// @throws InputError if it fails. Verified by: tests/lib/mat_file.test.cpp
[[nodiscard]] std::vector<MatArray> read_mat_arrays(const RecordFile& file);

}  // namespace impulse
