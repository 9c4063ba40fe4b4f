#pragma once

#include "lib/series/uniform_series.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace impulse {

/// What any method, impulse responses or finite elements, answers to an impact. All on one grid, t = 0 at first touch.
/// Sign: body 1 arrives with positive velocity, the force is positive in compression, both velocities count in the
/// direction in which body 1 moves.
struct ImpactHistory {
  UniformGrid grid;
  std::vector<double> force_N;             ///< zero after separation
  std::vector<double> velocity_1_m_per_s;  ///< of body 1's contact face
  std::vector<double> velocity_2_m_per_s;
  std::optional<double> acted_impulse_Ns =
      std::nullopt;        ///< ∫F dt of the force that acted, where the method knows it better than the samples tell
  bool separated = false;  ///< false: the record ended during contact
  double contact_end_s = 0;  ///< the linear zero of the force before the first of three successive samples ≤ 0; the
                             ///< record's end if not separated
  double energy_error = 0;   ///< |∫F(v₁ - v₂)dt| / (V ∫F dt), dimensionless
};

/// One line about an impact.
struct ImpactSummary {
  double peak_force_N = 0;
  double peak_time_s = 0;  ///< of the first sample within 1e-9 of the peak
  double contact_duration_s = 0;
  double impulse_Ns = 0;
  std::optional<double>
      rebound_speed_m_per_s;  ///< of body 1's centre of mass, V - ∫F dt/m₁; none if the mass is unknown
  double energy_error = 0;
};

/// Finds the end of contact in a force record: the first of three successive samples with F ≤ 0 (or ≤ 10⁻¹¹ of the
/// largest before, which is rounding) ends it, because a wave front that falls between samples spoils at most two.
/// Returns the index of the first of the three, or force.size().
[[nodiscard]] std::size_t contact_end_index(const std::vector<double>& force_N);

/// Time of the linear zero between samples end-1 and end (end = contact_end_index; the record's end if it is the size).
[[nodiscard]] double contact_end_s(const std::vector<double>& force_N, const UniformGrid& grid, std::size_t end);

/// Impulse ∫F dt: acted_impulse_Ns, or that of the piecewise linear samples (a release inside the last interval ends at
/// contact_end_s).
[[nodiscard]] double impulse_Ns(const ImpactHistory& history);

/// Verified by: tests/lib/impact_history.test.cpp
[[nodiscard]] ImpactSummary summary(const ImpactHistory& history, double speed_m_per_s,
                                    std::optional<double> mass_1_kg);

}  // namespace impulse
