#pragma once

#include "lib/transform/real_fft.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace impulse {

/// Division of power series truncated to N terms, i.e. the solution x of the lower-triangular Toeplitz system
///
///   Σ_{j≤n} w_{n-j} x_j = b_n,   n = 0 .. N-1,   w_0 ≠ 0,
///
/// by Newton's iteration for 1/w up to N/2 terms and one division step that uses it (Karp and Markstein). Cyclic
/// transforms of the target length suffice, since the part that wraps around is known. About 6.5 real transforms of
/// length 2N, 9.5 with the residual, 15.5 with a refinement. The object holds the plans for one N (rounded up to a
/// power of two); `divide` may be called any number of times. Error: ε·|w_0|·‖1/w‖₁ relative, repaired by one
/// refinement step where that is large. Reference: [KarpMarkstein1997], [BrentZimmermann2010] ch. 4. Verified by:
/// tests/lib/power_series.test.cpp
class PowerSeriesDivision {
 public:
  explicit PowerSeriesDivision(std::size_t size, RealFft::Planning planning = RealFft::Planning::estimate);

  struct Result {
    std::vector<double> quotient;
    double residual = 0;  ///< max_n |b_n - Σ w_{n-j} x_j|
    std::size_t refinements = 0;
  };
  /// Divides and measures the residual; refines once if it exceeds `tolerance`. The residual returned is that of the
  /// quotient returned; the caller judges it.
  [[nodiscard]] Result divide(std::span<const double> b, std::span<const double> w, double tolerance);

 private:
  void reciprocal(std::span<const double> w);
  void divide_once(std::span<const double> b, std::span<const double> w, std::span<double> x);
  double residual(std::span<const double> b, std::span<const double> x, std::span<double> r);

  std::size_t size_;           ///< as asked
  std::size_t length_;         ///< power of two ≥ size_, at least 2
  std::vector<RealFft> ffts_;  ///< lengths 2, 4, .. 2·length_
  RealBuffer reciprocal_;      ///< first length_/2 terms of 1/w
  ComplexBuffer reciprocal_spectrum_;
  ComplexBuffer w_spectrum_;
  ComplexBuffer full_w_spectrum_;
  ComplexBuffer work_spectrum_;
  RealBuffer time_;
};

}  // namespace impulse
