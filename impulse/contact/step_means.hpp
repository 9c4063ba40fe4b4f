#pragma once

#include <cstddef>
#include <vector>

namespace impulse {

/// Means over the steps, written on the samples: sample n is (x̄_{n-1} + x̄_n)/2, of order 2 where x is smooth, and its
/// trapezoidal sum over inner samples is that of the means. The ends are the caller's.
[[nodiscard]] inline std::vector<double> on_samples(const std::vector<double>& means, double first, double last) {
  std::vector<double> samples(means.size() + 1);
  samples.front() = first;
  for (std::size_t n = 1; n < means.size(); ++n) samples[n] = 0.5 * (means[n - 1] + means[n]);
  samples.back() = last;
  return samples;
}

}  // namespace impulse
