#pragma once

#include <optional>
#include <span>
#include <string>

namespace impulse {

/// Isotropic linear elastic material.
struct Material {
  std::string name;
  double youngs_modulus_Pa = 0;
  double density_kg_per_m3 = 0;
  std::optional<double> poissons_ratio;

  /// c = √(E/ρ), the speed of longitudinal waves in a slender rod [m/s].
  [[nodiscard]] double rod_wave_speed_m_per_s() const;
};

/// One row of the material table: constants with their source.
struct MaterialRecord {
  Material material;
  std::string source;
};

/// Every named material of the program.
[[nodiscard]] std::span<const MaterialRecord> material_table();

/// Reads a material: a name of the table (`steel`), a name with Poisson's ratio (`nylon-6:0.40`), or the constants
/// with units `E:ρ` or `E:ρ:ν` (`2.8GPa:1150kg/m3:0.40`).
/// @throws std::invalid_argument naming what is wrong, and the known names when the name is unknown.
/// Verified by: tests/lib/material.test.cpp
[[nodiscard]] Material parse_material(const std::string& text);

}  // namespace impulse
