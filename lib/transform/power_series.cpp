#include "lib/transform/power_series.hpp"

#include "lib/contract/require.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace impulse {
namespace {

/// The transform of length 2^(index + 1) stands at ffts[index].
std::size_t fft_index(std::size_t length) { return static_cast<std::size_t>(std::countr_zero(length)) - 1; }

void load(std::span<const double> from, std::size_t count, RealBuffer& time, std::size_t length) {
  const std::size_t available = std::min(count, from.size());
  std::copy_n(from.begin(), available, time.begin());
  std::fill(time.begin() + static_cast<std::ptrdiff_t>(available), time.begin() + static_cast<std::ptrdiff_t>(length),
            0.0);
}

/// Product of two spectra over the transform's length, which inverse_sum leaves out.
void multiply(ComplexBuffer& into, const ComplexBuffer& by, const RealFft& fft) {
  const std::size_t count = fft.spectrum_size();
  const double scale = 1.0 / static_cast<double>(fft.size());
  // Written out, since std::complex's product checks for infinities and does not vectorise.
  auto* x = reinterpret_cast<double*>(into.data());
  const auto* y = reinterpret_cast<const double*>(by.data());
  for (std::size_t k = 0; k < 2 * count; k += 2) {
    const double re = scale * (x[k] * y[k] - x[k + 1] * y[k + 1]);
    x[k + 1] = scale * (x[k] * y[k + 1] + x[k + 1] * y[k]);
    x[k] = re;
  }
}

}  // namespace

PowerSeriesDivision::PowerSeriesDivision(std::size_t size, RealFft::Planning planning)
    : size_(size), length_(std::max<std::size_t>(2, std::bit_ceil(size))) {
  require(size >= 1, "division of power series needs at least one term, not {}", size);
  for (std::size_t n = 2; n <= 2 * length_; n *= 2) ffts_.emplace_back(n, planning);
  reciprocal_.resize(length_ / 2);
  reciprocal_spectrum_.resize(length_ + 1);
  w_spectrum_.resize(length_ + 1);
  full_w_spectrum_.resize(length_ + 1);
  work_spectrum_.resize(length_ + 1);
  time_.resize(2 * length_);
}

void PowerSeriesDivision::reciprocal(std::span<const double> w) {
  reciprocal_[0] = 1.0 / w[0];
  for (std::size_t known = 1; known < length_ / 2; known *= 2) {
    const std::size_t length = 2 * known;
    const RealFft& fft = ffts_[fft_index(length)];
    load(w, length, time_, length);
    fft.forward(time_, w_spectrum_);
    load(std::span(reciprocal_).first(known), known, time_, length);
    fft.forward(time_, reciprocal_spectrum_);
    multiply(w_spectrum_, reciprocal_spectrum_, fft);
    fft.inverse_sum(w_spectrum_, time_);
    // w·g = 1 + z^known e + ...: what wraps around lands in the first half, which is known to be 1, 0, 0, ...
    std::fill_n(time_.begin(), known, 0.0);
    fft.forward(time_, w_spectrum_);
    multiply(w_spectrum_, reciprocal_spectrum_, fft);
    fft.inverse_sum(w_spectrum_, time_);
    for (std::size_t k = known; k < length; ++k) reciprocal_[k] = -time_[k];
  }
}

void PowerSeriesDivision::divide_once(std::span<const double> b, std::span<const double> w, std::span<double> x) {
  const std::size_t half = length_ / 2;
  const RealFft& fft = ffts_[fft_index(length_)];
  load(std::span(reciprocal_).first(half), half, time_, length_);
  fft.forward(time_, reciprocal_spectrum_);
  load(b, half, time_, length_);
  fft.forward(time_, work_spectrum_);
  multiply(work_spectrum_, reciprocal_spectrum_, fft);
  fft.inverse_sum(work_spectrum_, time_);
  std::copy_n(time_.begin(), std::min(half, size_), x.begin());
  if (size_ <= half) return;
  // Second half: (b - w·x_low) / w. The product's wrap-around lands in the first half, where it equals b and is not
  // needed.
  std::fill_n(time_.begin() + static_cast<std::ptrdiff_t>(half), half, 0.0);
  fft.forward(time_, work_spectrum_);
  load(w, length_, time_, length_);
  fft.forward(time_, w_spectrum_);
  multiply(work_spectrum_, w_spectrum_, fft);
  fft.inverse_sum(work_spectrum_, time_);
  std::fill_n(time_.begin(), half, 0.0);
  for (std::size_t k = half; k < length_; ++k) time_[k] = (k < b.size() ? b[k] : 0.0) - time_[k];
  fft.forward(time_, work_spectrum_);
  multiply(work_spectrum_, reciprocal_spectrum_, fft);
  fft.inverse_sum(work_spectrum_, time_);
  std::copy_n(time_.begin() + static_cast<std::ptrdiff_t>(half), size_ - half,
              x.begin() + static_cast<std::ptrdiff_t>(half));
}

double PowerSeriesDivision::residual(std::span<const double> b, std::span<const double> x, std::span<double> r) {
  const RealFft& fft = ffts_[fft_index(2 * length_)];
  load(x, size_, time_, 2 * length_);
  fft.forward(time_, work_spectrum_);
  multiply(work_spectrum_, full_w_spectrum_, fft);
  fft.inverse_sum(work_spectrum_, time_);
  double largest = 0;
  for (std::size_t k = 0; k < size_; ++k) {
    r[k] = b[k] - time_[k];
    // A NaN must not pass as a small residual.
    largest = std::isfinite(r[k]) ? std::max(largest, std::abs(r[k])) : HUGE_VAL;
  }
  return largest;
}

PowerSeriesDivision::Result PowerSeriesDivision::divide(std::span<const double> b, std::span<const double> w,
                                                        double tolerance) {
  require(b.size() == size_ && w.size() == size_, "division set up for {} terms got {} and {}", size_, b.size(),
          w.size());
  require(w[0] != 0, "the first coefficient of the divisor is 0, so the quotient is not a power series");
  Result result;
  result.quotient.resize(size_);
  reciprocal(w);
  divide_once(b, w, result.quotient);
  load(w, size_, time_, 2 * length_);
  ffts_[fft_index(2 * length_)].forward(time_, full_w_spectrum_);
  std::vector<double> r(size_);
  result.residual = residual(b, result.quotient, r);
  if (result.residual <= tolerance) return result;
  std::vector<double> correction(size_);
  divide_once(r, w, correction);
  for (std::size_t k = 0; k < size_; ++k) correction[k] += result.quotient[k];
  const double refined = residual(b, correction, r);
  result.refinements = 1;
  if (refined < result.residual) {
    result.quotient = std::move(correction);
    result.residual = refined;
  }
  return result;
}

}  // namespace impulse
