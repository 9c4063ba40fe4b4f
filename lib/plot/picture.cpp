#include "lib/plot/picture.hpp"

#include "lib/contract/require.hpp"
#include "lib/plot/thinning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace impulse {
namespace {

/// A gnuplot string; within single quotes nothing but the quote itself is special.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    result += c == '\n' ? ' ' : c;
  }
  return result + "'";
}

std::string terminal(const Frame& frame, PictureFormat format) {
  switch (format) {
    case PictureFormat::svg:
      return fmt::format("svg size {},{} noenhanced font 'sans,14' rounded background 'white'", frame.width_px,
                         frame.height_px);
    case PictureFormat::png:
      return fmt::format("pngcairo size {},{} noenhanced font 'sans,12' rounded background 'white'", frame.width_px,
                         frame.height_px);
    case PictureFormat::pdf:
      return fmt::format("pdfcairo size {:g}in,{:g}in noenhanced font 'sans,14' rounded",
                         static_cast<double>(frame.width_px) / 100, static_cast<double>(frame.height_px) / 100);
    case PictureFormat::text:
      break;
  }
  return "dumb size 79,24 noenhanced";
}

/// A palette that colour-blind readers can tell apart [Wong2011]; dashes begin when it is used up.
std::string curve_style(Mark mark, std::size_t index) {
  static constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
  const char* colour = colours[index % colours.size()];
  if (mark == Mark::points) return fmt::format("pt 6 ps 0.7 lw 1.6 lc rgb '{}'", colour);
  return fmt::format("lw 1.8 lc rgb '{}' dt {}", colour, 1 + index / colours.size());
}

/// Whether the curves' values of an axis differ at all; gnuplot widens an axis of none by itself.
bool has_extent(const Picture& picture, const std::vector<double> Curve::*values) {
  const double first = (picture.curves.front().*values).front();
  for (const Curve& curve : picture.curves)
    for (const double value : curve.*values)
      if (value != first) return true;
  return false;
}

void require_positive(const Axis& axis, const std::vector<double>& values) {
  if (!axis.logarithmic) return;
  for (const double value : values)
    require(value > 0, "{} goes down to {}, which a logarithmic axis has no place for", axis.label, value);
}

void require_drawable(const Picture& picture) {
  require(!picture.curves.empty(), "a picture needs at least one curve");
  for (std::size_t i = 0; i < picture.curves.size(); ++i) {
    const Curve& curve = picture.curves[i];
    const std::size_t least = curve.mark == Mark::points ? 1 : 2;
    require(curve.x.size() == curve.y.size() && curve.x.size() >= least,
            "curve {} has {} by {} points; it needs {} or more", i + 1, curve.x.size(), curve.y.size(), least);
    require_positive(picture.frame.x, curve.x);
    require_positive(picture.frame.y, curve.y);
  }
}

std::string data_block(const Curve& curve, std::size_t index) {
  std::string block = fmt::format("$curve{} << END\n", index);
  auto lift = curve.pen_lifts.begin();
  for (std::size_t k = 0; k < curve.x.size(); ++k) {
    if (lift != curve.pen_lifts.end() && *lift == k) {
      block += '\n';
      ++lift;
    }
    fmt::format_to(std::back_inserter(block), "{:.8g} {:.8g}\n", curve.x[k], curve.y[k]);
  }
  return block + "END\n";
}

void append_axis(std::string& script, const char* name, const Axis& axis) {
  auto out = std::back_inserter(script);
  if (axis.logarithmic) fmt::format_to(out, "set logscale {}\nset format {} '%g'\n", name, name);
  if (axis.range) fmt::format_to(out, "set {}range [{:.17g}:{:.17g}]\n", name, axis.range->from, axis.range->to);
}

/// Terminal, title, labels, ranges.
std::string preamble(const Frame& frame, PictureFormat format) {
  std::string script = fmt::format("set encoding utf8\nset terminal {}\n", terminal(frame, format));
  auto out = std::back_inserter(script);
  // The dumb terminal has no room for a label of the vertical axis.
  const std::string title = format != PictureFormat::text ? frame.title
                            : frame.title.empty()         ? frame.y.label
                                                          : frame.title + ": " + frame.y.label;
  if (!title.empty()) fmt::format_to(out, "set title {}\n", quoted(title));
  fmt::format_to(out, "set xlabel {}\n", quoted(frame.x.label));
  if (format != PictureFormat::text) fmt::format_to(out, "set ylabel {}\n", quoted(frame.y.label));
  append_axis(script, "x", frame.x);
  append_axis(script, "y", frame.y);
  if (frame.equal_scales) script += "set size ratio -1\n";
  return script;
}

bool has_legend(const Picture& picture) {
  const auto& curves = picture.curves;
  return std::any_of(curves.begin(), curves.end(), [&](const Curve& curve) { return curve.label != curves[0].label; });
}

double largest_magnitude(const FieldMap& map) {
  double largest = 0;
  for (const auto& scan : map.scans)
    for (const ScanPoint& point : scan) largest = std::max(largest, std::abs(point.z));
  return largest;
}

bool has_both_signs(const FieldMap& map) {
  bool negative = false, positive = false;
  for (const auto& scan : map.scans)
    for (const ScanPoint& point : scan) {
      negative = negative || point.z < 0;
      positive = positive || point.z > 0;
    }
  return negative && positive;
}

void require_drawable(const FieldMap& map, PictureFormat format) {
  require(format != PictureFormat::text, "a field can't be drawn in characters; write it to FILE.svg, .png or .pdf");
  require(map.scans.size() >= 2, "a field needs two lines of points or more, side by side; there is {}",
          map.scans.size());
  for (std::size_t i = 0; i < map.scans.size(); ++i)
    require(map.scans[i].size() >= 2 && map.scans[i].size() == map.scans[0].size(),
            "line {} of the field has {} points and the first {}; they need as many, two or more", i + 1,
            map.scans[i].size(), map.scans[0].size());
}

}  // namespace

std::string gnuplot_script(const Picture& picture, PictureFormat format) {
  require_drawable(picture);
  std::string script = preamble(picture.frame, format);
  for (std::size_t i = 0; i < picture.curves.size(); ++i)
    script += data_block(thinned(picture.curves[i], picture.frame.width_px, picture.frame.x.range), i);
  if (format != PictureFormat::text)
    script +=
        "set rmargin 4\nset border 3 lc rgb '#404040'\nset tics nomirror\nset grid lt 1 lc rgb '#d8d8d8' lw 0.8\n"
        "set xzeroaxis lt 1 lc rgb '#808080' lw 0.8\n";
  if (!picture.frame.x.range && has_extent(picture, &Curve::x)) script += "set autoscale xfix\n";
  if (!picture.frame.y.range && has_extent(picture, &Curve::y)) script += "set autoscale yfix\n";
  if (!picture.frame.y.range && !picture.frame.y.logarithmic) script += "set offsets 0, 0, graph 0.05, graph 0.05\n";
  // Above the axes: nowhere else is it sure not to cover a curve.
  const bool legend = has_legend(picture);
  script += legend ? "set key tmargin center horizontal reverse Left samplen 3\n" : "set key off\n";
  for (std::size_t i = 0; i < picture.curves.size(); ++i) {
    const Curve& curve = picture.curves[i];
    fmt::format_to(std::back_inserter(script), "{} $curve{} using 1:2 with {} {} title {}",
                   i == 0 ? "plot" : ", \\\n    ", i, curve.mark == Mark::points ? "points" : "lines",
                   format == PictureFormat::text ? "" : curve_style(curve.mark, legend ? i : 0), quoted(curve.label));
  }
  return script + "\n";
}

std::string gnuplot_script(const FieldMap& map, PictureFormat format) {
  require_drawable(map, format);
  std::string script = preamble(map.frame, format);
  auto out = std::back_inserter(script);
  script += "$field << END\n";
  for (const auto& scan : map.scans) {
    for (const ScanPoint& point : scan) fmt::format_to(out, "{:.8g} {:.8g} {:.8g}\n", point.x, point.y, point.z);
    script += '\n';
  }
  script +=
      "END\nset key off\nset tics nomirror\nset border lc rgb '#404040'\nset autoscale xfix\nset autoscale yfix\n";
  fmt::format_to(out, "set cblabel {}\n", quoted(map.z_label));
  if (has_both_signs(map)) {
    const double limit = largest_magnitude(map);
    fmt::format_to(out, "set cbrange [{:.8g}:{:.8g}]\nset palette defined (-1 '#2166ac', 0 '#f7f7f7', 1 '#b2182b')\n",
                   -limit, limit);
  } else {
    script += "set palette defined (0 '#f7fbff', 1 '#08306b')\n";
  }
  if (map.view == MapView::flat) {
    script += "set pm3d map\nsplot $field using 1:2:3 with pm3d\n";
  } else {
    script +=
        "set view 55,30\nset xyplane 0.1\nset pm3d depthorder border lc rgb '#606060' lw 0.4\n"
        "splot $field using 1:2:3 with pm3d\n";
  }
  return script;
}

}  // namespace impulse
