#pragma once

#include "lib/transform/real_fft.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace impulse {

/// Convolution with a known kernel w of a sequence x that becomes known one sample at a time:
///
///   history(n) = Σ_{k<n} w_{n-k} x_k,    n = 0 .. size-1, asked in that order, each followed by push(x_n).
///
/// Relaxed (block) scheme: when a dyadic block of x is complete, its contribution to the next block of the same length
/// is added by one cyclic transform against the kernel's spectrum, computed once per block length. Cost O(N log² N),
/// memory linear. The last samples within a block of `block_size` are summed directly. Verified by:
/// tests/lib/causal_convolution.test.cpp
class CausalConvolution {
 public:
  static constexpr std::size_t block_size = 128;

  explicit CausalConvolution(std::span<const double> kernel);

  [[nodiscard]] double history() const;
  void push(double value);
  [[nodiscard]] std::size_t count() const { return values_.size(); }

 private:
  struct Level {
    RealFft fft;
    ComplexBuffer kernel_spectrum;
  };
  void add_completed_blocks();
  Level& level(std::size_t block_length);

  std::span<const double> kernel_;
  std::vector<double> reversed_head_;  ///< w_{block_size-1} .. w_1: direct sums run forward through memory
  std::vector<double> values_;
  std::vector<double> pending_;  ///< what complete blocks add to later samples
  std::vector<Level> levels_;
  RealBuffer time_;
  ComplexBuffer spectrum_;
};

}  // namespace impulse
