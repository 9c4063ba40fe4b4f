#include "lib/material/ply.hpp"

#include "lib/contract/require.hpp"
#include "lib/material/constants_text.hpp"

#include <cmath>
#include <vector>

namespace impulse {
namespace {

constexpr double msi_Pa = 6.894757293168361e9;

PlyRecord graphite_epoxy() {
  return {{"graphite-epoxy", 120e9, 7.9e9, 0.30, 5.5e9, 5.5e9, 5.5e9, 1580}, "thesis, section 2.6.2"};
}

PlyRecord as4_3502() {
  return {{"as4-3502", 20 * msi_Pa, 1.3 * msi_Pa, 0.3, 0.87 * msi_Pa, 0.87 * msi_Pa, 0.51 * msi_Pa, 0},
          "thesis, section 3.2, in Msi; without a density"};
}

const Ply* find_ply(const std::string& name) {
  for (const PlyRecord& record : ply_table())
    if (record.ply.name == name) return &record.ply;
  return nullptr;
}

std::string known_names() {
  std::string names;
  for (const PlyRecord& record : ply_table()) names += (names.empty() ? "" : ", ") + record.ply.name;
  return names;
}

constexpr const char* example = "120GPa:7.9GPa:0.3:5.5GPa:5.5GPa:5.5GPa:1580kg/m3";

Ply named_ply(const std::string& text, const std::vector<std::string>& parts) {
  const Ply* named = find_ply(parts[0]);
  require(named != nullptr, "unknown ply '{}'; known are {}, or give constants E1:E2:nu12:G12:G13:G23:rho as {}",
          parts[0], known_names(), example);
  require(parts.size() <= 2, "ply '{}' has {} parts (a name takes only the density); expected {}:1600kg/m3", text,
          parts.size(), parts[0]);
  Ply ply = *named;
  if (parts.size() == 2) ply.density_kg_per_m3 = positive_constant(parts[1], "kg/m3", "density");
  require(ply.density_kg_per_m3 > 0, "ply '{0}' has no density in its source; add one, {0}:1600kg/m3", ply.name);
  return ply;
}

}  // namespace

std::span<const PlyRecord> ply_table() {
  static const std::vector<PlyRecord> table{graphite_epoxy(), as4_3502()};
  return table;
}

Ply parse_ply(const std::string& text) {
  const std::vector<std::string> parts = split_at_colons(text);
  if (!looks_like_number(parts[0])) return named_ply(text, parts);
  require(parts.size() == 7, "ply '{}' has {} part{}; expected E1:E2:nu12:G12:G13:G23:rho such as {}", text,
          parts.size(), parts.size() == 1 ? "" : "s", example);
  Ply ply{text,
          positive_constant(parts[0], "Pa", "modulus E1"),
          positive_constant(parts[1], "Pa", "modulus E2"),
          constant(parts[2], "1", "Poisson's ratio nu12"),
          positive_constant(parts[3], "Pa", "shear modulus G12"),
          positive_constant(parts[4], "Pa", "shear modulus G13"),
          positive_constant(parts[5], "Pa", "shear modulus G23"),
          positive_constant(parts[6], "kg/m3", "density")};
  require_valid(ply);
  return ply;
}

Ply isotropic_ply(const Material& material) {
  require(material.poissons_ratio.has_value(), "material '{0}' has no Poisson's ratio; add one, {0}:0.3",
          material.name);
  const double e = material.youngs_modulus_Pa, nu = *material.poissons_ratio, g = e / (2 * (1 + nu));
  const Ply ply{material.name, e, e, nu, g, g, g, material.density_kg_per_m3};
  require_valid(ply);
  return ply;
}

void require_valid(const Ply& ply) {
  const auto require_positive = [&](double value, const char* what) {
    require(std::isfinite(value) && value > 0, "ply '{}': {} {} is not positive and finite", ply.name, what, value);
  };
  require_positive(ply.modulus_1_Pa, "modulus E1");
  require_positive(ply.modulus_2_Pa, "modulus E2");
  require_positive(ply.shear_modulus_12_Pa, "shear modulus G12");
  require_positive(ply.shear_modulus_13_Pa, "shear modulus G13");
  require_positive(ply.shear_modulus_23_Pa, "shear modulus G23");
  require_positive(ply.density_kg_per_m3, "density");
  const double limit = std::sqrt(ply.modulus_1_Pa / ply.modulus_2_Pa);
  require(std::abs(ply.poissons_ratio_12) < limit,
          "ply '{}': Poisson's ratio nu12 = {} is outside (-{:.4g}, {:.4g}), the bounds sqrt(E1/E2) of a stable "
          "material; it may be nu21",
          ply.name, ply.poissons_ratio_12, limit, limit);
}

}  // namespace impulse
