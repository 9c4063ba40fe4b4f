#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace impulse {

/// Allocator of FFTW: memory aligned for its vector instructions.
template <class T>
struct FftAllocator {
  using value_type = T;
  FftAllocator() = default;
  template <class U>
  explicit FftAllocator(const FftAllocator<U>&) {}
  [[nodiscard]] T* allocate(std::size_t count);
  void deallocate(T* memory, std::size_t) noexcept;
  friend bool operator==(const FftAllocator&, const FftAllocator&) { return true; }
};
extern template struct FftAllocator<double>;
extern template struct FftAllocator<std::complex<double>>;

using RealBuffer = std::vector<double, FftAllocator<double>>;
using ComplexBuffer = std::vector<std::complex<double>, FftAllocator<std::complex<double>>>;

/// Real discrete Fourier transform of one size, one thread (FFTW):
///
///   forward:  X_k = Σ_j x_j e^(-2πi jk/n),  k = 0 .. n/2        inverse:  x_j = Σ_k X_k e^(+2πi jk/n) / n
///
/// (the inverse divides by n and sums the Hermitian continuation of X, so that it undoes the forward transform).
/// `estimate` plans in microseconds, `measure` by trial, for sizes that are used again and again.
/// Objects may be made and used by several threads, one object by one thread or by several with buffers of their own.
/// Verified by: tests/lib/real_fft.test.cpp
class RealFft {
 public:
  enum class Planning { estimate, measure };

  explicit RealFft(std::size_t size, Planning planning = Planning::estimate);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t spectrum_size() const { return size_ / 2 + 1; }

  void forward(const RealBuffer& time, ComplexBuffer& spectrum) const;
  /// Overwrites `spectrum`, as FFTW does.
  void inverse(ComplexBuffer& spectrum, RealBuffer& time) const;
  /// n times the inverse transform, for callers that divide where they pass over the data anyway.
  void inverse_sum(ComplexBuffer& spectrum, RealBuffer& time) const;

 private:
  struct Plans;
  std::size_t size_;
  std::shared_ptr<const Plans> plans_;
};

/// The smallest 2^a·3^b·5^c (a ≥ 1) that is at least `size`: a fast transform length.
[[nodiscard]] std::size_t fast_transform_size(std::size_t size);

/// First `count` samples of the convolution Σ_j a_j b_(n-j), by one zero-padded transform.
/// Error: a few ε·‖a‖₂‖b‖₂, uniformly over the samples.
[[nodiscard]] std::vector<double> convolution(std::span<const double> a, std::span<const double> b, std::size_t count);

}  // namespace impulse
