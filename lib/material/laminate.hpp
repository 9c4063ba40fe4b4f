#pragma once

#include "lib/material/ply.hpp"

#include <Eigen/Dense>

#include <string>
#include <vector>

namespace impulse {

/// A ply in its place.
struct Layer {
  Ply ply;
  double angle_deg = 0;  ///< of the fibres, from x towards y
  double thickness_m = 0;
};

/// Stiffness and inertia of a laminate per unit area about its middle surface z = 0:
///
///   (A, B, D) = ∫ Q̄ (1, z, z²) dz        forces and moments (N, M) = [A B; B D] (ε₀, κ), order x, y, xy
///   S = ∫ [Q̄44 Q̄45; Q̄45 Q̄55] dz         order yz, xz; without a shear correction factor
///   I = ∫ ρ (1, z, z²) dz
///
/// with engineering shear strains, Q̄ the plane-stress stiffness of each ply turned to x, y. Layers count from z = -h/2.
/// What is rounding of zero (the coupling of a symmetric layup) is exactly zero.
struct Laminate {
  double thickness_m = 0;
  Eigen::Matrix3d extension = Eigen::Matrix3d::Zero();         ///< A [N/m]
  Eigen::Matrix3d coupling = Eigen::Matrix3d::Zero();          ///< B [N]
  Eigen::Matrix3d bending = Eigen::Matrix3d::Zero();           ///< D [N m]
  Eigen::Matrix2d transverse_shear = Eigen::Matrix2d::Zero();  ///< S [N/m]
  double mass_kg_per_m2 = 0;                                   ///< I₀
  double mass_moment_kg_per_m = 0;                             ///< I₁
  double rotary_inertia_kg = 0;                                ///< I₂
};

/// @throws std::invalid_argument if there is no layer, or for a ply or a thickness that is not valid.
/// Verified by: tests/lib/laminate.test.cpp
[[nodiscard]] Laminate laminate(const std::vector<Layer>& layers);

/// Layers of one ply and equal thickness that fill the laminate's.
/// @throws std::invalid_argument as parse_layup.
[[nodiscard]] std::vector<Layer> layers_of(const std::string& layup, const Ply& ply, double total_thickness_m);

/// The laminate as a homogeneous orthotropic plate of the same thickness would be measured: constants of its mean
/// strains under loads in the plane (`in_plane`), and of its curvatures under moments (`flexural`), the other set of
/// loads being zero.
struct EngineeringConstants {
  double modulus_x_Pa = 0;
  double modulus_y_Pa = 0;
  double shear_modulus_xy_Pa = 0;
  double poissons_ratio_xy = 0;
  double poissons_ratio_yx = 0;
  double shear_coupling_x = 0;  ///< γxy/εx under σx
  double shear_coupling_y = 0;  ///< γxy/εy under σy
};

struct LaminateConstants {
  EngineeringConstants in_plane;  ///< from the block a of [a b; bᵀ d] = [A B; B D]⁻¹: Ex = 1/(h a11)
  EngineeringConstants flexural;  ///< from the block d: Ex = 12/(h³ d11)
};

[[nodiscard]] LaminateConstants engineering_constants(const Laminate& laminate);

}  // namespace impulse
