#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace impulse {

/// Half the last printed digit of a decimal number: `-1.98E-04` is known to 5e-7. 0 if it is no decimal.
[[nodiscard]] double printed_half_digit(std::string_view decimal);

/// How well printed values are known whose zeros at the end may be missing: `0` among `0.1` and `0.25` is known to
/// 0.005. With an exponent and always as many digits, each value by its own; else all by the last digit of the one with
/// most.
class PrintedDigits {
 public:
  void add(std::string_view decimal);
  [[nodiscard]] double half_digit(std::string_view decimal) const;

 private:
  double finest_ = 1e300;
  std::size_t mantissa_ = 0;
  bool same_mantissa_ = true;
};

/// The even abscissa x_k = start + k·step that printed values may stem from.
struct EvenTime {
  double start = 0;
  double step = 0;
  double least_step = 0;  ///< what the digits leave open: every step between these two
  double most_step = 0;   ///< explains all values
};

/// Finds out, one value at a time, whether values are an even abscissa, each known within a half width.
///
/// With |x_k - (a + k h)| ≤ e_k for all k, the steps h that explain all values are an interval: the gap
/// min_k(x_k + e_k - k h) - max_k(x_k - e_k - k h) is concave in h and must not be negative. Only the corners of two
/// convex hulls bind (of the upper ends from below, of the lower ends from above), so that memory is that of the hulls:
/// of n values rounded to a lattice about n^(1/3) corners. Of the admissible steps, and then starts, the one with
/// fewest digits is taken (for a step, its own digits or those of its rate). Cost: O(1) a value, amortised. Verified
/// by: tests/lib/even_time.test.cpp
class EvenTimeFit {
 public:
  void add(double value, double half_width);

  [[nodiscard]] std::size_t size() const { return size_; }

  /// Empty with fewer than two values, or if no positive step explains all of them.
  [[nodiscard]] std::optional<EvenTime> fit() const;

 private:
  struct Corner {
    double index, value;
  };
  [[nodiscard]] double upper_start(double step) const;
  [[nodiscard]] double lower_start(double step) const;
  [[nodiscard]] double gap(double step) const { return upper_start(step) - lower_start(step); }

  std::size_t size_ = 0;
  double first_ = 0, last_ = 0;
  bool hopeless_ = false;  ///< as many corners as a smooth curve has
  std::vector<Corner> upper_, lower_;
};

/// The number of fewest significant digits in [least, most]; 0 if it lies there.
[[nodiscard]] double roundest(double least, double most);

}  // namespace impulse
