#include "lib/series/uniform_series.hpp"

#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {
namespace {

/// Responses and their solution take 60 to 600 bytes a sample (a cone's waves 320, an impact of two files 600): 20 GB.
constexpr double most_samples = 1 << 25;

}  // namespace

bool same_grid(const UniformGrid& a, const UniformGrid& b) {
  return a.size == b.size && std::abs(a.step_s - b.step_s) <= 1e-9 * a.step_s;
}

UniformGrid grid_over(double duration_s, double step_s) {
  require(std::isfinite(step_s) && step_s > 0, "step {} s is not positive", step_s);
  require(std::isfinite(duration_s) && duration_s >= step_s,
          "duration {:.6g} s is shorter than one step of {:.6g} s; use a shorter step", duration_s, step_s);
  const double intervals = std::round(duration_s / step_s);
  require(
      intervals < most_samples,
      "duration {:.6g} s by step {:.6g} s makes {:.3g} samples (more than 2^25, {:.2g}, do not fit in memory); use a "
      "longer step or a shorter duration",
      duration_s, step_s, intervals, most_samples);
  return {step_s, static_cast<std::size_t>(intervals) + 1};
}

std::vector<double> cumulative_integral(const std::vector<double>& values, double step_s) {
  std::vector<double> integral(values.size());
  for (std::size_t k = 1; k < values.size(); ++k)
    integral[k] = integral[k - 1] + 0.5 * step_s * (values[k - 1] + values[k]);
  return integral;
}

std::vector<double> derivative(const std::vector<double>& x, double step_s) {
  const std::size_t n = x.size();
  require(n >= 3, "a derivative needs three samples, not {}", n);
  std::vector<double> slope(n);
  slope[0] = (-3 * x[0] + 4 * x[1] - x[2]) / (2 * step_s);
  for (std::size_t k = 1; k + 1 < n; ++k) slope[k] = (x[k + 1] - x[k - 1]) / (2 * step_s);
  slope[n - 1] = (3 * x[n - 1] - 4 * x[n - 2] + x[n - 3]) / (2 * step_s);
  return slope;
}

}  // namespace impulse
