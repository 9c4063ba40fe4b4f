#include "lib/material/material.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

using impulse::Material;
using impulse::parse_material;

TEST_CASE("material table holds the constants of the thesis") {
  struct Row {
    const char* name;
    double modulus, density;
  };
  for (const Row& row : {Row{"steel", 206e9, 7780}, {"aluminium", 69e9, 2700}, {"nylon-6", 2.8e9, 1150}}) {
    const Material material = parse_material(row.name);
    CHECK(material.name == row.name);
    CHECK(material.youngs_modulus_Pa == row.modulus);
    CHECK(material.density_kg_per_m3 == row.density);
    CHECK_FALSE(material.poissons_ratio.has_value());
  }
  for (const impulse::MaterialRecord& record : impulse::material_table()) CHECK_FALSE(record.source.empty());
}

TEST_CASE("rod wave speed is the root of modulus over density") {
  CHECK(parse_material("steel").rod_wave_speed_m_per_s() == impulse::about(std::sqrt(206e9 / 7780)).epsilon(1e-15));
}

TEST_CASE("parse_material reads constants and Poisson's ratio") {
  const Material nylon = parse_material("2.8GPa:1150kg/m3:0.40");
  CHECK(nylon.youngs_modulus_Pa == impulse::about(2.8e9).epsilon(1e-15));
  CHECK(nylon.density_kg_per_m3 == 1150);
  CHECK(nylon.poissons_ratio == 0.40);
  CHECK(parse_material("206e9:7780").youngs_modulus_Pa == 206e9);
  CHECK_FALSE(parse_material("206e9:7780").poissons_ratio.has_value());
  CHECK(parse_material("nylon-6:0.40").poissons_ratio == 0.40);
  CHECK(parse_material("nylon-6:0.40").youngs_modulus_Pa == 2.8e9);
}

TEST_CASE("parse_material says what is wrong") {
  CHECK_THROWS_WITH_AS((void)parse_material("steal"),
                       "unknown material 'steal'; known are steel, aluminium, nylon-6, or give constants as "
                       "2.8GPa:1150kg/m3",
                       std::invalid_argument);
  CHECK_THROWS_WITH((void)parse_material(""), doctest::Contains("unknown material ''"));
  CHECK_THROWS_WITH((void)parse_material("2.8GPa"), doctest::Contains("has 1 part;"));
  CHECK_THROWS_WITH((void)parse_material("1:2:0.3:4"), doctest::Contains("has 4 parts;"));
  CHECK_THROWS_WITH((void)parse_material("steel:7800:0.3"), doctest::Contains("a name takes only Poisson's ratio"));
  CHECK_THROWS_WITH((void)parse_material("2.8kg:1150"),
                    "modulus '2.8kg': wrong dimension: expected a modulus or stress such as 2.8GPa");
  CHECK_THROWS_WITH((void)parse_material("2.8GPa:1150m"), doctest::Contains("density '1150m': wrong dimension"));
  CHECK_THROWS_WITH((void)parse_material("-2GPa:1150"), "modulus '-2GPa' is not positive");
  CHECK_THROWS_WITH((void)parse_material("2GPa:0"), "density '0' is not positive");
  CHECK_THROWS_WITH((void)parse_material("steel:0.5"), "Poisson's ratio 0.5 is outside (-1, 0.5)");
  CHECK_THROWS_WITH((void)parse_material("steel:x"), doctest::Contains("Poisson's ratio 'x': not a number"));
}
