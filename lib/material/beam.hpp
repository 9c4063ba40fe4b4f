#pragma once

#include "lib/material/material.hpp"

#include <vector>

namespace impulse {

/// What holds a beam's ends: both hinged, both clamped, the end ξ = 0 clamped, or nothing.
enum class BeamSupports { simple, clamped, cantilever, free };

/// Uniform beam of rectangular section, struck across its length.
struct Beam {
  double length_m = 0;  ///< L
  double width_m = 0;   ///< b, across the force
  double height_m = 0;  ///< h, along the force
  Material material;
  BeamSupports supports = BeamSupports::simple;
  std::vector<double> contacts_at{0.5};  ///< ξ = x/L of each contact, in [0, 1] and not on a support

  [[nodiscard]] double area_m2() const;                ///< A = bh
  [[nodiscard]] double mass_kg() const;                ///< ρAL
  [[nodiscard]] double bending_stiffness_Nm2() const;  ///< EI, I = bh³/12
  [[nodiscard]] double slenderness_frequency() const;  ///< √(EI/(ρA))/L² [rad/s], so that ω = β² times this
  [[nodiscard]] double flexibility_m_per_N() const;    ///< L³/(EI)
};

/// @throws std::invalid_argument if `at` lies outside [0, 1] or on a support, where nothing moves.
void require_point(BeamSupports supports, double at);

/// @throws std::invalid_argument naming the value if a dimension, the modulus or the density is not positive and
/// finite, if there is no contact, and as require_point.
/// Verified by: tests/lib/beam.test.cpp
void require_valid(const Beam& beam);

}  // namespace impulse
