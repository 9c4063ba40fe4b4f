#include "lib/series/uniform_series.hpp"

#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {

bool same_grid(const UniformGrid& a, const UniformGrid& b) {
  return a.size == b.size && std::abs(a.step_s - b.step_s) <= 1e-9 * a.step_s;
}

UniformGrid grid_over(double duration_s, double step_s) {
  require(std::isfinite(step_s) && step_s > 0, "step {} s is not positive", step_s);
  require(std::isfinite(duration_s) && duration_s >= step_s, "duration {} s is shorter than one step of {} s", duration_s,
          step_s);
  const double intervals = std::round(duration_s / step_s);
  require(intervals < 2147483647.0, "duration {} s by step {} s makes {:.3g} samples (more than 2^31); use a longer step",
          duration_s, step_s, intervals);
  return {step_s, static_cast<std::size_t>(intervals) + 1};
}

std::vector<double> cumulative_integral(const std::vector<double>& values, double step_s) {
  std::vector<double> integral(values.size());
  for (std::size_t k = 1; k < values.size(); ++k)
    integral[k] = integral[k - 1] + 0.5 * step_s * (values[k - 1] + values[k]);
  return integral;
}

}  // namespace impulse
