#pragma once

#include "lib/material/profile.hpp"

namespace impulse {

/// Contact force while no echo has returned yet, body 1 a cone struck at face A (of impedance Z₁, D' its taper) on a
/// uniform bar of impedance Z₂:
///
///   F(t) = V Z₂ [1 - Z₂/(Z₁+Z₂) e^(-κ Z₁ t/(Z₁+Z₂))],   κ = c D'/D at the struck face (κ > 0: widening away from it;
///   0: cylinder)
///
/// Valid for 0 ≤ t < 2L/c of either body. With a = |D/D'| the distance of the struck face from the apex, |κ| = c/a.
/// Source: derived from V = (H₁ + H₂)*dF with H₁ = (1/Z₁)e^(-κt), H₂ = 1/Z₂. Verified by:
/// tests/impulse/contact_equation.test.cpp
[[nodiscard]] double cone_on_bar_force_N(const Segment& cone, const Segment& bar, double speed_m_per_s, double time_s);

}  // namespace impulse
