#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <random>
#include <vector>

/// Brute-force twins of the fast algorithms: nothing but the definition.
namespace impulse::direct {

inline std::vector<double> convolution(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> c(a.size());
  for (std::size_t n = 0; n < a.size(); ++n)
    for (std::size_t k = 0; k <= n; ++k) c[n] += a[n - k] * b[k];
  return c;
}

/// Forward substitution of Σ_{j≤n} w_{n-j} x_j = b_n.
inline std::vector<double> toeplitz_solution(const std::vector<double>& w, const std::vector<double>& b) {
  std::vector<double> x(b.size());
  for (std::size_t n = 0; n < b.size(); ++n) {
    double rest = b[n];
    for (std::size_t j = 0; j < n; ++j) rest -= w[n - j] * x[j];
    x[n] = rest / w[0];
  }
  return x;
}

inline std::vector<std::complex<double>> transform(const std::vector<double>& x) {
  std::vector<std::complex<double>> spectrum(x.size() / 2 + 1);
  for (std::size_t k = 0; k < spectrum.size(); ++k)
    for (std::size_t j = 0; j < x.size(); ++j)
      spectrum[k] +=
          x[j] * std::polar(1.0, -2 * M_PI * static_cast<double>(j * k % x.size()) / static_cast<double>(x.size()));
  return spectrum;
}

inline std::vector<double> random_values(std::size_t count, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> values(count);
  for (double& value : values) value = uniform(engine);
  return values;
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return HUGE_VAL;
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double difference = std::abs(a[k] - b[k]);
    if (!(difference <= largest)) largest = difference;  // a NaN stays
  }
  return largest;
}

}  // namespace impulse::direct
