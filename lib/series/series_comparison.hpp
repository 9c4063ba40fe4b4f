#pragma once

#include "lib/series/uniform_series.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace impulse {

/// What part of two series is compared.
struct ComparisonWindow {
  double end_s = 0;             ///< from 0 to here, at most the reference's duration
  std::vector<double> jumps_s;  ///< times at which the reference jumps, in any order
  std::size_t leave_out = 0;    ///< reference samples left out on each side of every jump, and one that lies on it
};

/// How far `other` is from `reference`, each relative to the reference's own value.
struct SeriesDifference {
  double relative_l2 = 0;                    ///< ‖x - x_ref‖/‖x_ref‖, ‖x‖² = ∫x² dt
  double peak_difference = 0;                ///< (p - p_ref)/p_ref, p the value of largest magnitude
  std::optional<double> impulse_difference;  ///< (I - I_ref)/I_ref, I = ∫x dt; none if I_ref = 0
};

/// Compares two piecewise linear series, exactly integrated on the union of their grids; a series is zero beyond its
/// last sample. Intervals of the reference that touch a sample left out count in none of the three. The peak is sought
/// on the union of the grids; if samples are left out, at the reference's samples that are kept. Cost: the sum of the
/// sample counts.
/// @throws std::invalid_argument if the window is empty or longer than the reference, nothing is left to compare, or
/// the reference is zero where it is compared. Verified by: tests/lib/series_comparison.test.cpp
[[nodiscard]] SeriesDifference series_difference(const UniformSeries& reference, const UniformSeries& other,
                                                 const ComparisonWindow& window);

/// End of the first contact in a force record that may begin with a gap (contact_end_s after the first positive
/// sample).
/// @throws std::invalid_argument if there is no positive sample.
[[nodiscard]] double first_contact_end_s(const UniformSeries& force_N);

}  // namespace impulse
