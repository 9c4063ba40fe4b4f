#pragma once

#include "lib/material/material.hpp"

#include <span>
#include <string>

namespace impulse {

/// A unidirectional ply: orthotropic in its axes 1 (along the fibres), 2 (across them, in the plane) and 3 (normal).
struct Ply {
  std::string name;
  double modulus_1_Pa = 0;
  double modulus_2_Pa = 0;
  double poissons_ratio_12 = 0;  ///< contraction along 2 under stress along 1; ν₂₁ = ν₁₂ E₂/E₁
  double shear_modulus_12_Pa = 0;
  double shear_modulus_13_Pa = 0;
  double shear_modulus_23_Pa = 0;
  double density_kg_per_m3 = 0;
};

/// One row of the ply table: constants with their source, density 0 where the source has none.
struct PlyRecord {
  Ply ply;
  std::string source;
};

/// Every named ply of the program.
[[nodiscard]] std::span<const PlyRecord> ply_table();

/// Reads a ply: a name of the table (`graphite-epoxy`), a name with the density (`as4-3502:1600kg/m3`), or the
/// constants with units `E1:E2:nu12:G12:G13:G23:rho` (`120GPa:7.9GPa:0.3:5.5GPa:5.5GPa:5.5GPa:1580kg/m3`).
/// @throws std::invalid_argument naming what is wrong, as require_valid does, and the known names when the name is
/// unknown. Verified by: tests/lib/ply.test.cpp
[[nodiscard]] Ply parse_ply(const std::string& text);

/// The isotropic material as a ply, G = E/(2(1+ν)).
/// @throws std::invalid_argument if it has no Poisson's ratio.
[[nodiscard]] Ply isotropic_ply(const Material& material);

/// @throws std::invalid_argument for a constant that is not positive or not finite, or |ν₁₂| ≥ √(E₁/E₂): the strain
/// energy would not be positive.
void require_valid(const Ply& ply);

}  // namespace impulse
