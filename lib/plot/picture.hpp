#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace impulse {

struct AxisRange {
  double from = 0;
  double to = 0;
};

struct Axis {
  std::string label;
  std::string si_unit;             ///< of the quantity; "" if there is none that all curves have
  double per_si = 1;               ///< what one SI unit is on the axis: 1e6 on one of microseconds
  std::optional<AxisRange> range;  ///< none: what the data need
  bool logarithmic = false;
};

/// What every picture has, whatever is drawn in it.
struct Frame {
  std::string title;
  Axis x;
  Axis y;
  std::size_t width_px = 900;  ///< of a PDF: hundredths of an inch
  std::size_t height_px = 500;
  bool equal_scales = false;  ///< a unit of x is as long as one of y: for bodies
};

enum class Mark { line, points };

struct Curve {
  std::string label;  ///< for the legend, which there is if two curves have different ones
  std::vector<double> x;
  std::vector<double> y;
  Mark mark = Mark::line;
  std::vector<std::size_t> pen_lifts;  ///< rising: before these points the line is interrupted
};

/// Curves over common axes.
struct Picture {
  Frame frame;
  std::vector<Curve> curves;
};

struct ScanPoint {
  double x = 0;
  double y = 0;
  double z = 0;
};

enum class MapView { flat, surface };

/// A field z over lines of points side by side, as many in each: a grid that may be skew and curved.
struct FieldMap {
  Frame frame;
  std::string z_label;
  std::vector<std::vector<ScanPoint>> scans;
  MapView view = MapView::flat;
};

enum class PictureFormat { text, svg, png, pdf };

/// The gnuplot program that draws the curves, their data inline. A line of more points than can be told apart is
/// drawn by its first, lowest, highest and last in each of as many stretches as the picture has columns.
/// @throws std::invalid_argument if there is no curve, or one has fewer than two points (a row of points: fewer than
/// one) or unequal lengths, or a logarithmic axis has values that are not positive.
/// Verified by: tests/lib/gnuplot.test.cpp
[[nodiscard]] std::string gnuplot_script(const Picture& picture, PictureFormat format);

/// The gnuplot program that draws the field, by colours that diverge from 0 if it has both signs.
/// @throws std::invalid_argument for fewer than two scans, scans of fewer than two points or unequal numbers, or
/// characters (PictureFormat::text), in which no field can be drawn.
[[nodiscard]] std::string gnuplot_script(const FieldMap& map, PictureFormat format);

}  // namespace impulse
