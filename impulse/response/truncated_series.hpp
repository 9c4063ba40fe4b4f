#pragma once

#include <array>
#include <cstddef>

namespace impulse {

/// Power series a₀ + a₁q + ... + a₆q⁶, truncated. T is double or std::complex<double>.
template <class T>
struct TruncatedSeries {
  static constexpr std::size_t size = 7;
  std::array<T, size> a{};

  TruncatedSeries() = default;
  explicit TruncatedSeries(T constant) { a[0] = constant; }

  friend TruncatedSeries operator+(TruncatedSeries x, const TruncatedSeries& y) {
    for (std::size_t k = 0; k < size; ++k) x.a[k] += y.a[k];
    return x;
  }
  friend TruncatedSeries operator-(TruncatedSeries x, const TruncatedSeries& y) {
    for (std::size_t k = 0; k < size; ++k) x.a[k] -= y.a[k];
    return x;
  }
  friend TruncatedSeries operator*(T scale, TruncatedSeries x) {
    for (T& value : x.a) value *= scale;
    return x;
  }
  friend TruncatedSeries operator*(const TruncatedSeries& x, const TruncatedSeries& y) {
    TruncatedSeries product;
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; i + j < size; ++j) product.a[i + j] += x.a[i] * y.a[j];
    return product;
  }
  friend TruncatedSeries operator/(const TruncatedSeries& x, const TruncatedSeries& y) {
    TruncatedSeries quotient;
    const T reciprocal = T(1) / y.a[0];
    for (std::size_t n = 0; n < size; ++n) {
      T rest = x.a[n];
      for (std::size_t k = 1; k <= n; ++k) rest -= y.a[k] * quotient.a[n - k];
      quotient.a[n] = rest * reciprocal;
    }
    return quotient;
  }
};

/// 1/s as a series in q = 1/(s + μ): q + μq² + μ²q³ + ...
template <class T>
TruncatedSeries<T> inverse_s_series(double mu) {
  TruncatedSeries<T> series;
  T power = T(1);
  for (std::size_t k = 1; k < TruncatedSeries<T>::size; ++k, power *= T(mu)) series.a[k] = power;
  return series;
}

}  // namespace impulse
