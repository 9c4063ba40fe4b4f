#pragma once

#include "lib/material/material.hpp"

#include <Eigen/Dense>

namespace impulse {

/// Linear elasticity of a solid of revolution that moves without twist, σ = C ε, components in the order
/// rr, θθ, zz, rz with the engineering shear γ_rz, and its density.
struct AxisymmetricElasticity {
  Eigen::Matrix4d stiffness;     ///< C [Pa]
  double density_kg_per_m3 = 0;  ///< > 0

  /// c_L = √(C_zz/ρ), the speed of plane dilatational waves along the axis [m/s].
  [[nodiscard]] double axial_wave_speed_m_per_s() const;
};

/// @throws std::invalid_argument if Poisson's ratio is missing or outside (-1, 0.5).
/// Verified by: tests/fem/axisymmetric_elasticity.test.cpp
[[nodiscard]] AxisymmetricElasticity isotropic_elasticity(const Material& material);

/// A material that is the same in all directions across the axis: a bar of unidirectional fibres.
struct TransverseIsotropy {
  double axial_modulus_Pa = 0;           ///< E_a, along the axis
  double transverse_modulus_Pa = 0;      ///< E_t, across it
  double axial_poissons_ratio = 0;       ///< ν_a = -ε_t/ε_a under axial stress
  double transverse_poissons_ratio = 0;  ///< ν_t, across the axis
  double axial_shear_modulus_Pa = 0;     ///< G_rz
  double density_kg_per_m3 = 0;
};

/// Inverse of the compliance [1/E_t -ν_t/E_t -ν_a/E_a; . 1/E_t -ν_a/E_a; . . 1/E_a] and G_rz.
/// @throws std::invalid_argument unless moduli and density are positive and the strain energy is positive:
/// |ν_t| < 1, 2 ν_a² E_t/E_a < 1 - ν_t. Verified by: tests/fem/axisymmetric_elasticity.test.cpp
[[nodiscard]] AxisymmetricElasticity transversely_isotropic_elasticity(const TransverseIsotropy& material);

}  // namespace impulse
