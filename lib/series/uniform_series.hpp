#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace impulse {

/// Samples at t_k = k·step_s, k = 0 .. size-1: the sampling of every signal in the program.
struct UniformGrid {
  double step_s = 0;
  std::size_t size = 0;

  /// k·step, as k/n where the step is 1/n to rounding: 12 steps of 40 µs are 0.00048, not 0.00047999999999999996.
  [[nodiscard]] double time_s(std::size_t index) const {
    const double per_second = std::nearbyint(1 / step_s);
    const bool whole = std::abs(per_second * step_s - 1) < 4e-16;
    return whole ? static_cast<double>(index) / per_second : step_s * static_cast<double>(index);
  }
  friend bool operator==(const UniformGrid&, const UniformGrid&) = default;
  [[nodiscard]] double duration_s() const { return size == 0 ? 0 : time_s(size - 1); }
};

/// The same samples: equal in number, steps equal within 1e-9 (a step read back from a file is a rounded quotient).
[[nodiscard]] bool same_grid(const UniformGrid& a, const UniformGrid& b);

/// The grid of round(duration/step) + 1 samples, both ends in (3e-4 s by 1e-4 s has 4). The one place where a
/// duration becomes a number of samples.
/// @throws std::invalid_argument unless 0 < step ≤ duration, both finite, and there are at most 2^25 samples.
/// Verified by: tests/lib/uniform_series.test.cpp
[[nodiscard]] UniformGrid grid_over(double duration_s, double step_s);

struct UniformSeries {
  UniformGrid grid;
  std::vector<double> values;
};

/// ∫₀ᵗ x dt on the same grid by the trapezoidal rule, starting from 0. Order 2.
/// Verified by: tests/lib/uniform_series.test.cpp
[[nodiscard]] std::vector<double> cumulative_integral(const std::vector<double>& values, double step_s);

/// dx/dt on the same grid by central differences, one-sided of three samples at the ends. Order 2.
/// @throws std::invalid_argument for fewer than three samples. Verified by: tests/lib/uniform_series.test.cpp
[[nodiscard]] std::vector<double> derivative(const std::vector<double>& values, double step_s);

}  // namespace impulse
