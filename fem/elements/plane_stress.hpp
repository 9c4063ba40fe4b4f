#pragma once

#include "lib/material/material.hpp"

#include <Eigen/Dense>

namespace impulse {

/// Four corners (x, y), counter-clockwise.
using QuadrilateralCorners = Eigen::Matrix<double, 4, 2>;
using QuadrilateralMatrix = Eigen::Matrix<double, 8, 8>;

/// How the quadrilateral bends.
enum class Quadrilateral {
  bilinear,      ///< plain: too stiff in bending by about ½(1-ν)(length/height)² of one element (shear locking)
  incompatible,  ///< with the bending modes of Taylor, Beresford and Wilson (QM6), condensed
};

/// Plane stress element of four nodes and two displacements each, (u₁, v₁, ..., u₄, v₄), thickness t:
///
///   K = ∫ t BᵀDB dA,   D = E/(1-ν²) [1 ν 0; ν 1 0; 0 0 (1-ν)/2],   2 × 2 Gauss points
///
/// `incompatible` adds 1-ξ² and 1-η² to both displacements, internal to the element. Their derivatives are taken
/// with the Jacobian of the centre and scaled by its determinant over the point's, so that they integrate to zero: a
/// constant strain leaves them at rest on any shape of element (the patch test). Rectangles then bend exactly.
/// @throws std::invalid_argument unless the corners form a convex quadrilateral counter-clockwise, and if the material
/// has no Poisson's ratio or one outside (-1, 0.5). Reference: [TaylorBeresfordWilson1976]. Verified by:
/// tests/fem/plane_stress.test.cpp
[[nodiscard]] QuadrilateralMatrix plane_stress_stiffness(const QuadrilateralCorners& corners, const Material& material,
                                                         double thickness_m, Quadrilateral kind);

/// M = ∫ ρt NNᵀ dA of the bilinear interpolation, exact (2 × 2 Gauss points).
[[nodiscard]] QuadrilateralMatrix plane_stress_consistent_mass(const QuadrilateralCorners& corners,
                                                               double density_kg_per_m3, double thickness_m);

/// Row sums of the consistent mass, ∫ ρt Nᵢ dA for each node [kg].
[[nodiscard]] Eigen::Vector4d plane_stress_lumped_mass(const QuadrilateralCorners& corners, double density_kg_per_m3,
                                                       double thickness_m);

/// Largest angular frequency of the one free element with lumped mass [rad/s]. No mesh of such elements vibrates
/// faster than its fastest element.
[[nodiscard]] double plane_stress_highest_frequency(const QuadrilateralCorners& corners, const Material& material,
                                                    Quadrilateral kind);

}  // namespace impulse
