#pragma once

#include <string>

namespace impulse {

/// Runs gnuplot on a script and returns what it draws. The same script gives the same bytes: a PDF's date is fixed.
/// @throws std::runtime_error if gnuplot is not installed or fails, with its message.
/// Verified by: tests/lib/gnuplot.test.cpp
[[nodiscard]] std::string gnuplot_output(const std::string& script);

}  // namespace impulse
