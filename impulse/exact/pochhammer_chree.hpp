#pragma once

#include "lib/numerics/cubic_spline.hpp"

namespace impulse {

/// Phase velocity of the first longitudinal mode of a round bar with a free surface, over c0 = √(E/ρ), exactly
/// (three-dimensional elasticity, Pochhammer and Chree). With k = κ/a the wave number, a the radius, ω = k c,
///
///   2p(q² + k²) J1(pa) J1(qa) - a (q² - k²)² J0(pa) J1(qa) - 4 a k² p q J1(pa) J0(qa) = 0,
///   p² = ω²/c_L² - k²,   q² = ω²/c_T² - k²,
///
/// and c is its lowest root; it falls from 1 (c/c0 ≈ 1 - ν²κ²/4, Rayleigh) towards the speed of Rayleigh waves,
/// which it may reach from slightly (at most 3 %) below.
/// Solved as an even function of p and q, so that real and imaginary ones are one case. Error about 1e-13.
/// @throws std::invalid_argument unless κ ≥ 0 is finite and 0 ≤ ν ≤ 0.5.
/// Reference: [Bancroft1941]. Verified by: tests/impulse/pochhammer_chree.test.cpp
[[nodiscard]] double pochhammer_chree_speed_ratio(double radius_wave_number, double poissons_ratio);

/// Speed of Rayleigh waves over c0: the limit of the above for short waves.
/// @throws std::invalid_argument unless 0 ≤ ν ≤ 0.5. Verified by: tests/impulse/pochhammer_chree.test.cpp
[[nodiscard]] double rayleigh_speed_ratio(double poissons_ratio);

/// The same phase velocity as a function of frequency, for corrections that ask for thousands of values: a cubic spline
/// through exact points at Ω = ω a/c0, from 0 to a highest one.
/// Error below 2e-10, i.e. a phase of 2e-7 rad after 100 diameters at Ω = 5. Cost: about 10 µs a point, 300 points per
/// decade above Ω = 3, 100 per unit below.
class BarDispersion {
 public:
  /// @throws std::invalid_argument unless 0 ≤ ν ≤ 0.5 and the highest Ω is positive and finite.
  /// Verified by: tests/impulse/pochhammer_chree.test.cpp
  BarDispersion(double poissons_ratio, double highest_radius_frequency);

  /// c/c0 at Ω = ω a/c0. @throws std::invalid_argument for Ω < 0 or beyond the highest.
  [[nodiscard]] double speed_ratio(double radius_frequency) const;

 private:
  CubicSpline spline_;
};

}  // namespace impulse
