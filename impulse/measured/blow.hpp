#pragma once

#include "lib/series/uniform_series.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// One hammer blow: the force on a body and its answer, sampled together.
struct Blow {
  std::string name;  ///< in messages: its file
  std::vector<double> force_N;
  std::vector<double> response;  ///< as recorded, later m/s
};

/// How a pulse is told from noise.
struct BlowOptions {
  double trigger = 0.05;    ///< of the peak force: where the pulse begins and ends, in (0, 1)
  double second_hit = 0.1;  ///< of the peak force: what counts as another hit outside the pulse, in (0, 1)
  std::optional<double> force_window_s = {};  ///< from the pulse's beginning; empty: its end and half its length beyond
};

enum class BlowFault { none, no_pulse, clipped_force, clipped_response, second_hit };

/// What a message says about a fault.
[[nodiscard]] std::string description(BlowFault fault);

struct BlowWindow {
  BlowFault fault = BlowFault::none;
  std::size_t begin = 0;      ///< first sample of the blow
  std::size_t force_end = 0;  ///< one past the last sample at which the force is not taken for zero
};

/// Finds the pulse of a blow and what is wrong with it. The pulse reaches from the peak to where the force falls below
/// `trigger` of it, or below five standard deviations of the noise (from the median deviation of the record) where that
/// is more, with half its length added at both ends. Clipped is a channel that stays at its largest or smallest value
/// for three samples and leaves it again; a second hit exceeds `second_hit` of the peak, and six standard deviations,
/// outside the force window.
/// @throws std::invalid_argument for fractions outside (0, 1) or channels that differ in length.
/// Verified by: tests/impulse/blow.test.cpp
[[nodiscard]] BlowWindow examined_blow(const Blow& blow, double step_s, const BlowOptions& options);

/// The blow from its beginning, `size` samples of it, its force zero beyond the window.
/// @throws std::invalid_argument if there are fewer.
[[nodiscard]] Blow windowed(const Blow& blow, const BlowWindow& window, std::size_t size);

/// Subtracts the mean of the first `count` samples.
/// @throws std::invalid_argument unless 0 < count ≤ size. Verified by: tests/impulse/blow.test.cpp
void remove_offset(std::vector<double>& values, std::size_t count);

/// Takes a straight line through 0 at the beginning off a velocity, so that the mean of its last tenth becomes
/// `final_mean_m_per_s`: what a constant error of an accelerometer integrates to.
/// @throws std::invalid_argument for fewer than ten samples. Verified by: tests/impulse/blow.test.cpp
void remove_drift(std::vector<double>& velocity_m_per_s, double final_mean_m_per_s);

}  // namespace impulse
