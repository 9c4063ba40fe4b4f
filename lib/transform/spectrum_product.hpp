#pragma once

#include "lib/transform/real_fft.hpp"

#include <complex>
#include <cstddef>

namespace impulse {

/// into_k ← into_k · by_k over the shorter of the two. Written out, since std::complex's product checks for infinities
/// and does not vectorise. Verified by: tests/lib/real_fft.test.cpp
inline void multiply(ComplexBuffer& into, const ComplexBuffer& by) {
  auto* x = reinterpret_cast<double*>(into.data());
  const auto* y = reinterpret_cast<const double*>(by.data());
  const std::size_t count = 2 * std::min(into.size(), by.size());
  for (std::size_t k = 0; k < count; k += 2) {
    const double re = x[k] * y[k] - x[k + 1] * y[k + 1];
    x[k + 1] = x[k] * y[k + 1] + x[k + 1] * y[k];
    x[k] = re;
  }
}

/// into_k ← into_k · conj(by_k): correlation where the product is convolution.
inline void multiply_conjugate(ComplexBuffer& into, const ComplexBuffer& by) {
  auto* x = reinterpret_cast<double*>(into.data());
  const auto* y = reinterpret_cast<const double*>(by.data());
  const std::size_t count = 2 * std::min(into.size(), by.size());
  for (std::size_t k = 0; k < count; k += 2) {
    const double re = x[k] * y[k] + x[k + 1] * y[k + 1];
    x[k + 1] = x[k + 1] * y[k] - x[k] * y[k + 1];
    x[k] = re;
  }
}

}  // namespace impulse
