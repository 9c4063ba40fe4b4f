#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace impulse {

/// Solvers of the lower-triangular Toeplitz system Σ_{j≤n} w_{n-j} x_j = b_n, w_0 > 0.

/// Forward substitution with relaxed convolution, O(N log² N). Stops early when `ended` says so of the samples so far;
/// the rest stay 0. Backward stable like plain substitution. Verified by: tests/impulse/toeplitz_solvers.test.cpp
template <class Ended>
[[nodiscard]] std::vector<double> marched_toeplitz(std::span<const double> w, std::span<const double> b, Ended&& ended);

/// Newton's division of power series with its residual checked; where that stays above `tolerance` after a refinement,
/// forward substitution instead (ringing kernels with a huge ‖1/w‖₁). @throws ConvergenceError if even that misses the
/// tolerance.
[[nodiscard]] std::vector<double> series_toeplitz(std::span<const double> w, std::span<const double> b,
                                                  double tolerance);

/// Division of the transforms on |z| = e^(-9/N), N the size, period 4N: aliases enter by e^-27, rounding by ε e^9.
/// @throws ConvergenceError if the residual exceeds `tolerance`.
[[nodiscard]] std::vector<double> contour_toeplitz(std::span<const double> w, std::span<const double> b,
                                                   double tolerance);

}  // namespace impulse

#include "lib/transform/causal_convolution.hpp"

namespace impulse {

template <class Ended>
std::vector<double> marched_toeplitz(std::span<const double> w, std::span<const double> b, Ended&& ended) {
  std::vector<double> x(b.size(), 0.0);
  CausalConvolution past(w);
  for (std::size_t n = 0; n < b.size(); ++n) {
    x[n] = (b[n] - past.history()) / w[0];
    if (ended(std::span<const double>(x).first(n + 1))) break;
    past.push(x[n]);
  }
  return x;
}

}  // namespace impulse
