#include "lib/series/series_comparison.hpp"

#include "lib/contract/require.hpp"
#include "lib/law/impact_history.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace impulse {
namespace {

/// Nodes nearer than this part of a step are one: the steps of two files differ by rounding.
constexpr double same_node = 1e-6;

struct Ends {
  double begin, end;
};

/// Values of the piecewise linear series at both ends of [a, b], which lies within one of its intervals or beyond them.
Ends values_on(const UniformSeries& series, double a, double b) {
  const double h = series.grid.step_s;
  const auto i = static_cast<std::size_t>(0.5 * (a + b) / h);
  if (i + 1 >= series.values.size()) return {0, 0};
  const double slope = series.values[i + 1] - series.values[i];
  const auto at = [&](double t) { return series.values[i] + (t / h - static_cast<double>(i)) * slope; };
  return {at(a), at(b)};
}

double square_integral(const Ends& x, double width) {
  return width / 3 * (x.begin * x.begin + x.begin * x.end + x.end * x.end);
}

/// Marks the samples within `leave_out` of a jump, on either side and on the jump itself.
std::vector<char> left_out_samples(const UniformGrid& grid, const ComparisonWindow& window) {
  std::vector<char> marks(grid.size, 0);
  if (window.leave_out == 0) return marks;
  const double width = static_cast<double>(window.leave_out) - 1;
  const double last = static_cast<double>(grid.size) - 1;
  for (const double jump : window.jumps_s) {
    const double position = jump / grid.step_s;
    const double first_mark = std::max(0.0, std::ceil(position - same_node) - 1 - width);
    const double last_mark = std::min(last, std::floor(position + same_node) + 1 + width);
    for (double k = first_mark; k <= last_mark; ++k) marks[static_cast<std::size_t>(k)] = 1;
  }
  return marks;
}

/// All nodes of both grids in [0, end], ascending.
std::vector<double> union_nodes(const UniformGrid& a, const UniformGrid& b, double end) {
  const double nearest = same_node * std::min(a.step_s, b.step_s);
  std::vector<double> nodes;
  std::size_t i = 0, j = 0;
  while (i < a.size || j < b.size) {
    const bool take_a = j >= b.size || (i < a.size && a.time_s(i) <= b.time_s(j));
    const double t = take_a ? a.time_s(i++) : b.time_s(j++);
    if (t >= end - nearest) break;
    if (nodes.empty() || t - nodes.back() > nearest) nodes.push_back(t);
  }
  nodes.push_back(end);
  return nodes;
}

struct Sums {
  double square_reference = 0, square_difference = 0;
  double impulse_reference = 0, impulse_other = 0;
  double peak_reference = 0, peak_other = 0;
  double width = 0;
};

void raise_peak(double& peak, double value) {
  if (std::abs(value) > std::abs(peak)) peak = value;
}

void require_series(const UniformSeries& series) {
  require(series.values.size() == series.grid.size && series.grid.size >= 2 && series.grid.step_s > 0,
          "{} values on a grid of {} with step {} s", series.values.size(), series.grid.size, series.grid.step_s);
}

}  // namespace

SeriesDifference series_difference(const UniformSeries& reference, const UniformSeries& other,
                                   const ComparisonWindow& window) {
  require_series(reference);
  require_series(other);
  const double step = reference.grid.step_s;
  require(window.end_s > 0 && window.end_s <= reference.grid.duration_s() + same_node * step,
          "the window ends at {} s, outside (0, {}] s of the reference", window.end_s, reference.grid.duration_s());
  const std::vector<char> left_out = left_out_samples(reference.grid, window);
  const bool all_kept = std::find(left_out.begin(), left_out.end(), 1) == left_out.end();

  Sums sums;
  const std::vector<double> nodes = union_nodes(reference.grid, other.grid, window.end_s);
  for (std::size_t n = 0; n + 1 < nodes.size(); ++n) {
    const double a = nodes[n], b = nodes[n + 1], width = b - a;
    const std::size_t i = std::min(static_cast<std::size_t>(0.5 * (a + b) / step), reference.grid.size - 2);
    if (left_out[i] || left_out[i + 1]) continue;
    const Ends x = values_on(reference, a, b), y = values_on(other, a, b);
    sums.width += width;
    sums.square_reference += square_integral(x, width);
    sums.square_difference += square_integral({y.begin - x.begin, y.end - x.end}, width);
    sums.impulse_reference += 0.5 * width * (x.begin + x.end);
    sums.impulse_other += 0.5 * width * (y.begin + y.end);
    const auto is_sample = [&](double t) { return std::abs(t / step - std::round(t / step)) <= same_node; };
    for (const auto& [t, of_x, of_y] : {std::tuple(a, x.begin, y.begin), std::tuple(b, x.end, y.end)}) {
      if (!all_kept && !is_sample(t)) continue;
      raise_peak(sums.peak_reference, of_x);
      raise_peak(sums.peak_other, of_y);
    }
  }
  require(sums.width > 0, "no interval is left to compare; leave out fewer samples than {}", window.leave_out);
  require(sums.square_reference > 0 && sums.peak_reference != 0, "the reference is zero where it is compared");

  SeriesDifference difference;
  difference.relative_l2 = std::sqrt(sums.square_difference / sums.square_reference);
  difference.peak_difference = (sums.peak_other - sums.peak_reference) / sums.peak_reference;
  if (sums.impulse_reference != 0)
    difference.impulse_difference = (sums.impulse_other - sums.impulse_reference) / sums.impulse_reference;
  return difference;
}

double first_contact_end_s(const UniformSeries& force_N) {
  const std::vector<double>& force = force_N.values;
  const auto first = std::find_if(force.begin(), force.end(), [](double f) { return f > 0; });
  require(first != force.end(), "the force is nowhere positive (there is no contact)");
  const auto gap = static_cast<std::size_t>(first - force.begin());
  const std::size_t end = gap + contact_end_index({first, force.end()});
  return contact_end_s(force, force_N.grid, end);
}

}  // namespace impulse
