#include "impulse/measured/band_filter.hpp"

#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace impulse {

using std::numbers::pi;

BandFilter::BandFilter(double highest) {
  require(highest > 0 && highest <= 0.5, "the highest frequency, {} of the sampling frequency, is not in (0, 0.5]",
          highest);
  decimation_ = std::max<std::size_t>(1, static_cast<std::size_t>(0.3 / highest));
  if (decimation_ == 1) {
    taps_ = {1};
    return;
  }
  const double cutoff = 0.35 / static_cast<double>(decimation_);
  const double half = 12 * static_cast<double>(decimation_);
  double sum = 0;
  for (double i = -half; i <= half; ++i) {
    const double window = 0.42 + 0.5 * std::cos(pi * i / half) + 0.08 * std::cos(2 * pi * i / half);
    taps_.push_back(window * (i == 0 ? 2 * cutoff : std::sin(2 * pi * cutoff * i) / (pi * i)));
    sum += taps_.back();
  }
  for (double& tap : taps_) tap /= sum;
}

std::complex<double> BandFilter::gain(std::complex<double> z) const {
  std::complex<double> sum = 0;
  const std::complex<double> inverse = 1.0 / z;
  for (auto tap = taps_.rbegin(); tap != taps_.rend(); ++tap) sum = sum * inverse + *tap;
  return sum;
}

std::vector<double> BandFilter::filtered(const std::vector<double>& x) const {
  std::vector<double> y;
  for (std::size_t last = first(); last < x.size(); last += decimation_) {
    double sum = 0;
    for (std::size_t i = 0; i < taps_.size(); ++i) sum += taps_[i] * x[last - i];
    y.push_back(sum);
  }
  return y;
}

}  // namespace impulse
