#pragma once

#include <string>
#include <vector>

namespace impulse {

struct Curve {
  std::string label;  ///< for the legend, which there is if there are two curves or more
  std::vector<double> x;
  std::vector<double> y;
};

struct Picture {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Curve> curves;
};

enum class PictureFormat { text, svg, png, pdf };

/// The gnuplot program that draws the curves, their data inline.
/// @throws std::invalid_argument if there is no curve, or one has fewer than two points or unequal lengths.
[[nodiscard]] std::string gnuplot_script(const Picture& picture, PictureFormat format);

/// Runs gnuplot on a script and returns what it draws. The same script gives the same bytes: a PDF's date is fixed.
/// @throws std::runtime_error if gnuplot is not installed or fails, with its message.
/// Verified by: tests/lib/gnuplot.test.cpp
[[nodiscard]] std::string gnuplot_output(const std::string& script);

}  // namespace impulse
