#pragma once

#include "impulse/measured/least_squares_kernel.hpp"
#include "impulse/response/response.hpp"
#include "lib/transform/real_fft.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

/// Synthetic measurements with a seed.
namespace impulse::records {

inline std::vector<double> noise(std::size_t count, double sigma, std::mt19937_64& engine) {
  std::normal_distribution<double> normal(0, sigma);
  std::vector<double> values(count);
  for (double& value : values) value = normal(engine);
  return values;
}

/// A half sine of `length` intervals from sample `begin` on.
inline std::vector<double> half_sine(std::size_t size, std::size_t begin, std::size_t length, double peak) {
  std::vector<double> force(size);
  for (std::size_t k = 0; k <= length && begin + k < size; ++k)
    force[begin + k] = peak * std::sin(std::numbers::pi * static_cast<double>(k) / static_cast<double>(length));
  return force;
}

/// Face velocity of a body under a force that is linear over each step and begins at 0: exact, from U (second
/// differences over the step).
inline std::vector<double> velocity(const PairResponse& body, double step_s, const std::vector<double>& force) {
  const std::vector<double>& u = body.step_displacement_m_per_N;
  std::vector<double> weights(force.size());
  for (std::size_t k = 0; k < weights.size(); ++k)
    weights[k] = (u[k + 1] - 2 * u[k] + (k == 0 ? u[0] : u[k - 1])) / step_s;
  return convolution(weights, force, force.size());
}

inline void add_noise(std::vector<double>& values, double sigma, std::mt19937_64& engine) {
  const std::vector<double> added = noise(values.size(), sigma, engine);
  for (std::size_t n = 0; n < values.size(); ++n) values[n] += added[n];
}

inline double rms(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace impulse::records
