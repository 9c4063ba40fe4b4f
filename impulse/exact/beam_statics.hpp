#pragma once

#include "lib/material/beam.hpp"

#include <Eigen/Dense>

namespace impulse {

/// Static influence function of a beam (Euler-Bernoulli), p × p [m/N]: deflection at contact i under a unit force at
/// contact j. With G in units of L³/(EI), positions ξ ≤ η as fractions of L:
///
///   simple      ξ(1-η)[1 - ξ² - (1-η)²]/6
///   clamped     ξ²(1-η)²[3η - ξ(1+2η)]/6
///   cantilever  ξ²(3η - ξ)/6                                        (ξ = 0 clamped)
///   free        the elastic part alone: a force at η is balanced by the inertia of the rigid motion that it causes,
///               and the deflection is freed of rigid motion. With s = ξ - ½, e = η - ½, valid in either order:
///               |s-e|³/12 - s⁴/24 - es⁵/10 - s²/16 + es³/4 + a + bs,
///               a = 11/1920 - [(½-e)⁴ + (½+e)⁴]/48,
///               b = [(½+e)⁵ - (½-e)⁵]/5 - e[(½-e)⁴ + (½+e)⁴]/4 + 3e/1120 - 3e/80
///
/// It is Σ φₙ(ξ)φₙ(η)/ωₙ² over the elastic modes.
/// @throws std::invalid_argument for an invalid beam. Verified by: tests/impulse/beam_modes.test.cpp
[[nodiscard]] Eigen::MatrixXd beam_static_flexibility(const Beam& beam);

}  // namespace impulse
