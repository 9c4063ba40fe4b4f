#pragma once

#include <functional>

namespace impulse {

struct RootTolerance {
  double absolute = 0;
  double relative = 1e-14;
  int max_iterations = 200;
};

/// A root of f in [low, high], f(low) and f(high) of opposite sign (or one of them zero), by Brent's method (GSL).
/// @throws std::invalid_argument if the bracket holds no sign change, ConvergenceError if the tolerance is missed.
/// Verified by: tests/lib/roots.test.cpp
[[nodiscard]] double bracketed_root(const std::function<double(double)>& f, double low, double high,
                                    const RootTolerance& tolerance = {});

/// The same by bisection (GSL), for where the published procedure is bisection.
[[nodiscard]] double bisected_root(const std::function<double(double)>& f, double low, double high,
                                   const RootTolerance& tolerance = {});

}  // namespace impulse
