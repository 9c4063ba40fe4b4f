#include "lib/transform/causal_convolution.hpp"

#include <algorithm>

namespace impulse {

CausalConvolution::CausalConvolution(std::span<const double> kernel)
    : kernel_(kernel), reversed_head_(block_size, 0.0), pending_(kernel.size(), 0.0) {
  values_.reserve(kernel.size());
  // reversed_head_[block_size - j] = w_j, so that x_{n-m} .. x_{n-1} meets w_m .. w_1 at matching offsets.
  for (std::size_t j = 1; j < std::min(block_size, kernel.size()); ++j) reversed_head_[block_size - j] = kernel[j];
}

double CausalConvolution::history() const {
  const std::size_t n = values_.size();
  const std::size_t in_block = n % block_size;
  const double* x = values_.data() + (n - in_block);
  const double* w = reversed_head_.data() + (block_size - in_block);
  double sum[4] = {0, 0, 0, 0};
  std::size_t k = 0;
  for (; k + 4 <= in_block; k += 4)
    for (std::size_t lane = 0; lane < 4; ++lane) sum[lane] += w[k + lane] * x[k + lane];
  for (; k < in_block; ++k) sum[0] += w[k] * x[k];
  const double carried = n < pending_.size() ? pending_[n] : 0.0;
  return carried + ((sum[0] + sum[1]) + (sum[2] + sum[3]));
}

void CausalConvolution::push(double value) {
  values_.push_back(value);
  if (values_.size() % block_size == 0 && values_.size() < kernel_.size()) add_completed_blocks();
}

CausalConvolution::Level& CausalConvolution::level(std::size_t block_length) {
  std::size_t index = 0;
  while ((block_size << index) < block_length) ++index;
  while (levels_.size() <= index) {
    const std::size_t length = block_size << levels_.size();
    RealFft fft(2 * length);
    RealBuffer time(fft.size(), 0.0);
    std::copy_n(kernel_.begin(), std::min(fft.size(), kernel_.size()), time.begin());
    ComplexBuffer spectrum(fft.spectrum_size());
    fft.forward(time, spectrum);
    levels_.push_back({std::move(fft), std::move(spectrum)});
  }
  return levels_[index];
}

void CausalConvolution::add_completed_blocks() {
  const std::size_t n = values_.size();
  // The largest dyadic block that ends at n: its samples reach the next `length` outputs through w_1 .. w_{2·length-1}.
  const std::size_t length = n & (~n + 1);
  Level& here = level(length);
  time_.assign(here.fft.size(), 0.0);
  std::copy_n(values_.end() - static_cast<std::ptrdiff_t>(length), length, time_.begin());
  spectrum_.resize(here.fft.spectrum_size());
  here.fft.forward(time_, spectrum_);
  for (std::size_t k = 0; k < spectrum_.size(); ++k) spectrum_[k] *= here.kernel_spectrum[k];
  here.fft.inverse(spectrum_, time_);
  // Cyclic wrap-around spoils the first half only; the second half holds the outputs n .. n+length-1.
  const std::size_t reach = std::min(length, pending_.size() - n);
  for (std::size_t k = 0; k < reach; ++k) pending_[n + k] += time_[length + k];
}

}  // namespace impulse
