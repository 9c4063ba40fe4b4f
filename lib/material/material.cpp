#include "lib/material/material.hpp"

#include "lib/contract/require.hpp"
#include "lib/material/constants_text.hpp"

#include <cmath>
#include <vector>

namespace impulse {
namespace {

MaterialRecord thesis_material(const char* name, double youngs_modulus_Pa, double density_kg_per_m3) {
  return {{name, youngs_modulus_Pa, density_kg_per_m3, std::nullopt}, "thesis, section 4.5; [OdeenLundberg1991]"};
}

const Material* find_material(const std::string& name) {
  for (const MaterialRecord& record : material_table())
    if (record.material.name == name) return &record.material;
  return nullptr;
}

std::string known_names() {
  std::string names;
  for (const MaterialRecord& record : material_table()) names += (names.empty() ? "" : ", ") + record.material.name;
  return names;
}

double poissons_ratio(const std::string& text) {
  const double value = constant(text, "1", "Poisson's ratio");
  require(value > -1 && value < 0.5, "Poisson's ratio {} is outside (-1, 0.5)", value);
  return value;
}

}  // namespace

double Material::rod_wave_speed_m_per_s() const { return std::sqrt(youngs_modulus_Pa / density_kg_per_m3); }

std::span<const MaterialRecord> material_table() {
  static const std::vector<MaterialRecord> table{
      thesis_material("steel", 206e9, 7780),
      thesis_material("aluminium", 69e9, 2700),
      thesis_material("nylon-6", 2.8e9, 1150),
  };
  return table;
}

Material parse_material(const std::string& text) {
  const std::vector<std::string> parts = split_at_colons(text);
  if (!looks_like_number(parts[0])) {
    const Material* named = find_material(parts[0]);
    require(named != nullptr, "unknown material '{}'; known are {}, or give constants as 2.8GPa:1150kg/m3", parts[0],
            known_names());
    require(parts.size() <= 2, "material '{}' has {} parts (a name takes only Poisson's ratio); expected {}:0.3", text,
            parts.size(), parts[0]);
    Material material = *named;
    if (parts.size() == 2) material.poissons_ratio = poissons_ratio(parts[1]);
    return material;
  }
  require(parts.size() == 2 || parts.size() == 3,
          "material '{}' has {} part{}; expected modulus:density or modulus:density:Poisson's ratio such as "
          "2.8GPa:1150kg/m3:0.40",
          text, parts.size(), parts.size() == 1 ? "" : "s");
  Material material{text, positive_constant(parts[0], "Pa", "modulus"), positive_constant(parts[1], "kg/m3", "density"),
                    std::nullopt};
  if (parts.size() == 3) material.poissons_ratio = poissons_ratio(parts[2]);
  return material;
}

}  // namespace impulse
