#pragma once

#include "impulse/measured/least_squares_kernel.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace impulse {

struct Bootstrap {
  std::size_t resamples = 0;  ///< R ≥ 40; a standard uncertainty is then known to 1/√(2R) of itself
  std::size_t seed = 1;
  std::size_t threads = 0;  ///< 0: one for each processor
};

/// Deviations of an estimate from B records by resampling: x_r is estimated from B records drawn with replacement, and
///
///   d_r = √(B/((B-1)(R-1))) (x_r - x̄),   r = 1 .. R,   so that Σ d_r d_rᵀ is the covariance.
///
/// The factor B/(B-1) is what the variance of resamples lacks: exactly for estimates linear in the draw, such as a
/// mean. It is what the closed form of least_squares_kernel.hpp tends to for many records that differ little
/// (docs/decisions/0014). Estimates of unequal length are cut to the shortest. Memory: R estimates.
/// @throws std::invalid_argument for fewer than 2 records or 40 resamples; what `estimate` throws, which must bear
/// being called from several threads. Verified by: tests/impulse/bootstrap.test.cpp
[[nodiscard]] std::vector<std::vector<double>> bootstrap_deviations(
    std::span<const InputOutput> records, const Bootstrap& options,
    const std::function<std::vector<double>(std::span<const InputOutput>)>& estimate);

}  // namespace impulse
