#pragma once

#include "fem/elements/axisymmetric_elasticity.hpp"

#include <Eigen/Dense>

namespace impulse {

/// Nodes of a 6-node triangle, (r, z) in rows [m]: corners 1, 2, 3 counterclockwise (r to the right, z upwards), then
/// the nodes between 1 and 2, 2 and 3, 3 and 1.
using TriangleNodes = Eigen::Matrix<double, 6, 2>;

/// Of the degrees of freedom u_r1, u_z1, u_r2, u_z2, ...
using TriangleMatrix = Eigen::Matrix<double, 12, 12>;
using TriangleVector = Eigen::Matrix<double, 12, 1>;

/// Ring of triangular section, quadratic isoparametric interpolation, no twist:
///
///   K = ∫ Bᵀ C B 2πr dA,   ε = (u_r,r ; u_r/r ; u_z,z ; u_r,z + u_z,r) = B u      [N/m], for the whole ring
///
/// by Gauss' rule of seven points, of degree 5. On a straight-sided element all terms but N_iN_j/r of the hoop strain
/// are integrated exactly, and those too where a side lies on the axis (N_i/r is a polynomial for the nodes off it), so
/// a homogeneous state of strain is exact anywhere. The rows of u_r at nodes on the axis, where u_r = 0, mean nothing
/// and are to be left out.
/// @throws std::invalid_argument if the element is turned inside out at a Gauss point (Jacobian ≤ 0) or a Gauss point
/// is not at r > 0. Verified by: tests/fem/axisymmetric_triangle.test.cpp
[[nodiscard]] TriangleMatrix axisymmetric_triangle_stiffness(const TriangleNodes& nodes,
                                                             const AxisymmetricElasticity& material);

///   M = ∫ ρ N_iN_j 2πr dA  in both directions [kg]; exact on straight-sided elements.
[[nodiscard]] TriangleMatrix axisymmetric_triangle_consistent_mass(const TriangleNodes& nodes,
                                                                   double density_kg_per_m3);

/// Diagonal of the consistent mass, scaled to the mass of the ring in each direction (Hinton, Rock and Zienkiewicz'
/// lumping): positive, where row sums give the corners of a quadratic triangle none.
[[nodiscard]] TriangleVector axisymmetric_triangle_lumped_mass(const TriangleNodes& nodes, double density_kg_per_m3);

/// Loads [N] on the nodes at r_1, r_2 and between them of a side across the axis under a uniform unit pressure,
/// ∫ N_i 2πr dr. The node between takes 2/3 of the load on a narrow ring; a node on the axis takes nothing.
[[nodiscard]] Eigen::Vector3d axisymmetric_side_load(double r_1_m, double r_2_m);

}  // namespace impulse
