#pragma once

#include "lib/material/profile.hpp"

#include <Eigen/Dense>

namespace impulse {

/// Axial element of two nodes on a cylinder or cone frustum (a `Segment` of length h, end diameters D₁ and D₂). With x
/// the distance from the apex, ψ = x·u is interpolated linearly, so u = a + b/x: the static solution of the cone under
/// end forces. The element is exact in statics, contains the rigid motion (b = 0), and a cylinder is its limit.
///
///   K = E (π/4) D₁D₂/h [1 -1; -1 1]
///
/// Why ψ: D ∝ x, so between elements of equal h on one cone row j of Ku, with the row-sum mass
/// m_j = ρh(π/4) D_j(D_{j-1} + 4D_j + D_{j+1})/6 = ρhA_j (as D_{j-1} + D_{j+1} = 2D_j), reads
///
///   ψ̈_j = (c/h)² (ψ_{j-1} - 2ψ_j + ψ_{j+1}),   c = √(E/ρ),
///
/// which central differences with the step h/c turn into ψ_j(t+Δt) + ψ_j(t-Δt) = ψ_{j-1}(t) + ψ_{j+1}(t): d'Alembert's
/// solution at the nodes, without dispersion. See docs/decisions/0002-bar-element.md.
/// Units: N/m and kg. Order: 1 → D₁ (end A), 2 → D₂.
/// Preconditions: the segment is valid (require_valid(Bar)).
/// Verified by: tests/fem/bar_element.test.cpp
[[nodiscard]] Eigen::Matrix2d bar_element_stiffness(const Segment& element);

///   M = ρh(π/4)/6 [2D₁² D₁D₂; D₁D₂ 2D₂²]: exact integrals of the interpolation; the sum of the entries is the mass.
[[nodiscard]] Eigen::Matrix2d bar_element_consistent_mass(const Segment& element);

/// Row sums of the consistent mass, ρh(π/4)/6 [D₁(2D₁ + D₂), D₂(D₁ + 2D₂)]; the total is the mass of the frustum.
[[nodiscard]] Eigen::Vector2d bar_element_lumped_mass(const Segment& element);

/// Largest angular frequency of the one free element with lumped mass, ω² = k(1/m₁ + 1/m₂) [rad/s]; 2c/h if D₁ = D₂ and
/// (2c/h)√(1 + ε²/9 + ...) if D₂ = (1 + ε)D₁. No mesh of such elements vibrates faster than its fastest element.
[[nodiscard]] double bar_element_highest_frequency(const Segment& element);

}  // namespace impulse
