#pragma once

#include <functional>

namespace impulse {

/// A search ends when the bracket is no wider than absolute + max(relative, 4ε)·|x|.
struct RootTolerance {
  double absolute = 0;       ///< ≥ 0, in the unit of x; a root at x = 0 needs one, unless f is hit at exactly 0
  double relative = 1e-14;   ///< ≥ 0
  int max_iterations = 200;  ///< > 0
};

/// A root of f in [low, high], f(low) and f(high) of opposite sign (or one of them zero), by Brent's method (GSL).
/// An exception thrown by f reaches the caller.
/// @throws std::invalid_argument if the bracket holds no sign change, f is not finite in it or the tolerance is
/// negative; ConvergenceError if the tolerance is missed.
/// Verified by: tests/lib/roots.test.cpp
[[nodiscard]] double bracketed_root(const std::function<double(double)>& f, double low, double high,
                                    const RootTolerance& tolerance = {});

/// The same by bisection (GSL), for where the published procedure is bisection.
[[nodiscard]] double bisected_root(const std::function<double(double)>& f, double low, double high,
                                   const RootTolerance& tolerance = {});

}  // namespace impulse
