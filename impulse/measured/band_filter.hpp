#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace impulse {

/// Low-pass filter and decimation that leave sums of exponentials sums of exponentials.
///
/// y_j = Σ_i h_i x_(first + q j - i) wherever all of h lies on the record, h a Blackman-windowed sinc of 24 q + 1 taps
/// with unit gain at frequency 0: flat to 0.2/q of the sampling frequency, 74 dB down beyond 0.5/q. An exponential z^k
/// becomes gain(z) z^(first + q j) exactly. For q = 1 nothing is filtered.
class BandFilter {
 public:
  /// For frequencies up to `highest` (in units of the sampling frequency): q = floor(0.3/highest), at least 1.
  /// @throws std::invalid_argument unless 0 < highest ≤ 0.5. Verified by: tests/impulse/mode_identification.test.cpp
  explicit BandFilter(double highest);

  [[nodiscard]] std::size_t decimation() const { return decimation_; }
  /// Sample of x to which y_0 belongs as the last one used.
  [[nodiscard]] std::size_t first() const { return taps_.size() - 1; }
  [[nodiscard]] std::complex<double> gain(std::complex<double> z) const;
  [[nodiscard]] std::vector<double> filtered(const std::vector<double>& x) const;

 private:
  std::size_t decimation_;
  std::vector<double> taps_;
};

}  // namespace impulse
