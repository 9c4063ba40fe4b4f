#pragma once

#include <Eigen/Dense>

namespace impulse {

/// Bending element of two nodes, uniform over its length h, Euler-Bernoulli theory: deflection and rotation w' at each
/// node, in the order (w₁, θ₁, w₂, θ₂), cubic Hermite interpolation. Exact in statics under loads at the nodes.
///
///   K = EI/h³ [12  6h  -12  6h;  6h  4h²  -6h  2h²;  -12  -6h  12  -6h;  6h  2h²  -6h  4h²]
///
/// Preconditions: stiffness, density and length positive. Verified by: tests/fem/hermite_beam.test.cpp
[[nodiscard]] Eigen::Matrix4d hermite_beam_stiffness(double bending_stiffness_Nm2, double length_m);

///   M = ρAh/420 [156  22h  54  -13h;  22h  4h²  13h  -3h²;  54  13h  156  -22h;  -13h  -3h²  -22h  4h²]
///
/// the exact integral ∫ρA NNᵀ dx; frequencies of order 4, from above.
[[nodiscard]] Eigen::Matrix4d hermite_beam_consistent_mass(double mass_kg_per_m, double length_m);

/// Shape functions N(t) at the fraction t of the length, so that w = N·(w₁, θ₁, w₂, θ₂).
[[nodiscard]] Eigen::Vector4d hermite_beam_shape(double fraction, double length_m);

}  // namespace impulse
