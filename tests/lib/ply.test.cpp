#include "lib/material/ply.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

using impulse::parse_ply;
using impulse::Ply;

TEST_CASE("ply table holds the constants of the thesis") {
  const Ply panel = parse_ply("graphite-epoxy");
  CHECK(panel.modulus_1_Pa == 120e9);
  CHECK(panel.modulus_2_Pa == 7.9e9);
  CHECK(panel.poissons_ratio_12 == 0.30);
  CHECK(panel.shear_modulus_12_Pa == 5.5e9);
  CHECK(panel.shear_modulus_13_Pa == 5.5e9);
  CHECK(panel.shear_modulus_23_Pa == 5.5e9);
  CHECK(panel.density_kg_per_m3 == 1580);
  const Ply nasa = parse_ply("as4-3502:1600kg/m3");
  CHECK(nasa.modulus_1_Pa == impulse::about(137.895e9).epsilon(1e-5));  // 20 Msi
  CHECK(nasa.shear_modulus_23_Pa == impulse::about(3.51633e9).epsilon(1e-5));
  CHECK(nasa.density_kg_per_m3 == 1600);
  for (const impulse::PlyRecord& record : impulse::ply_table()) CHECK_FALSE(record.source.empty());
}

TEST_CASE("parse_ply reads constants with units") {
  const Ply ply = parse_ply("20Mpsi:1.3Mpsi:0.3:6GPa:5GPa:4GPa:1.6g/cm3");
  CHECK(ply.modulus_1_Pa == impulse::about(137.895e9).epsilon(1e-5));
  CHECK(ply.poissons_ratio_12 == 0.3);
  CHECK(ply.shear_modulus_12_Pa == 6e9);
  CHECK(ply.shear_modulus_13_Pa == 5e9);
  CHECK(ply.shear_modulus_23_Pa == 4e9);
  CHECK(ply.density_kg_per_m3 == impulse::about(1600).epsilon(1e-14));
}

TEST_CASE("an isotropic material as a ply") {
  const Ply ply = impulse::isotropic_ply(impulse::parse_material("206GPa:7780kg/m3:0.3"));
  CHECK(ply.modulus_1_Pa == ply.modulus_2_Pa);
  CHECK(ply.shear_modulus_13_Pa == impulse::about(206e9 / 2.6).epsilon(1e-15));
  CHECK_THROWS_WITH((void)impulse::isotropic_ply(impulse::parse_material("steel")),
                    "material 'steel' has no Poisson's ratio; add one, steel:0.3");
}

TEST_CASE("parse_ply says what is wrong") {
  CHECK_THROWS_WITH_AS((void)parse_ply("carbon"),
                       doctest::Contains("unknown ply 'carbon'; known are graphite-epoxy, as4-3502, or give constants"),
                       std::invalid_argument);
  CHECK_THROWS_WITH((void)parse_ply("as4-3502"),
                    "ply 'as4-3502' has no density in its source; add one, as4-3502:1600kg/m3");
  CHECK_THROWS_WITH((void)parse_ply("graphite-epoxy:1:2"), doctest::Contains("a name takes only the density"));
  CHECK_THROWS_WITH((void)parse_ply("1:2:3"), doctest::Contains("has 3 parts; expected E1:E2:nu12:G12:G13:G23:rho"));
  CHECK_THROWS_WITH((void)parse_ply("0:1:0:1:1:1:1"), "modulus E1 '0' is not positive");
  CHECK_THROWS_WITH((void)parse_ply("1:1:0:1:1:-1:1"), "shear modulus G23 '-1' is not positive");
  CHECK_THROWS_WITH((void)parse_ply("1:1:0:1:1:1:1m"), doctest::Contains("density '1m': wrong dimension"));
  CHECK_THROWS_WITH((void)parse_ply("4:1:2:1:1:1:1"), doctest::Contains("nu12 = 2 is outside (-2, 2)"));
  CHECK_NOTHROW((void)parse_ply("4:1:1.99:1:1:1:1"));
}
