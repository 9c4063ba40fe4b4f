#pragma once

#include "lib/plot/picture.hpp"

#include <vector>

namespace impulse {

/// Points listed line by line as lines: a new one begins where the way from point to point turns back (by more than a
/// right angle), as it does at the end of a line of a quadrilateral grid, skew or curved.
/// Verified by: tests/lib/scans.test.cpp
[[nodiscard]] std::vector<std::vector<ScanPoint>> scan_lines(const std::vector<ScanPoint>& points);

}  // namespace impulse
