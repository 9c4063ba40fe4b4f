#pragma once

#include <memory>
#include <vector>

namespace impulse {

/// Natural cubic spline through points (GSL). Error of order h⁴ away from the ends.
class CubicSpline {
 public:
  /// @throws std::invalid_argument unless there are at least three points with ascending x.
  CubicSpline(std::vector<double> x, std::vector<double> y);

  /// @throws std::invalid_argument if x lies outside the points. Verified by: tests/lib/special_functions.test.cpp
  [[nodiscard]] double operator()(double x) const;

  [[nodiscard]] double last() const { return last_; }

 private:
  struct Spline;
  std::shared_ptr<const Spline> spline_;
  double first_;
  double last_;
};

}  // namespace impulse
