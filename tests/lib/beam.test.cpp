#include "lib/material/beam.hpp"

#include "tests/support/about.hpp"
#include "tests/support/beams.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace impulse;

TEST_CASE("beam: section, mass and bending stiffness of a rectangle") {
  Beam beam = beams::timoshenko();
  beam.length_m = 2;
  beam.width_m = 0.03;
  beam.height_m = 0.1;
  beam.material = parse_material("4GPa:1000kg/m3");
  CHECK(beam.area_m2() == about(3e-3));
  CHECK(beam.mass_kg() == about(6));
  CHECK(beam.bending_stiffness_Nm2() == about(4e9 * 0.03 * 1e-3 / 12));
  CHECK(beam.flexibility_m_per_N() == about(8 / 1e4));
  CHECK(beam.slenderness_frequency() == about(std::sqrt(1e4 / 3) / 4));
}

TEST_CASE("beam: refuses what is no beam, and points outside it or on its supports") {
  const auto refuses = [](auto change, const char* message) {
    Beam beam = beams::timoshenko();
    change(beam);
    CHECK_THROWS_WITH_AS(require_valid(beam), doctest::Contains(message), std::invalid_argument);
  };
  refuses([](Beam& b) { b.length_m = 0; }, "length 0 m is not positive");
  refuses([](Beam& b) { b.width_m = -1; }, "width -1 m is not positive");
  refuses([](Beam& b) { b.height_m = 1.0 / 0.0; }, "height inf m is not positive and finite");
  refuses([](Beam& b) { b.material.youngs_modulus_Pa = 0; }, "modulus 0 Pa");
  refuses([](Beam& b) { b.material.density_kg_per_m3 = 0; }, "density 0 kg/m3");
  refuses([](Beam& b) { b.contacts_at.clear(); }, "at least one point");
  refuses([](Beam& b) { b.contacts_at = {0.5, 1.5}; }, "point at 1.5 of the length lies outside");
  refuses([](Beam& b) { b.contacts_at = {-0.1}; }, "point at -0.1 of the length lies outside");
  for (const BeamSupports supports : beams::all_supports)
    for (const double end : {0.0, 1.0}) {
      const Beam beam = beams::timoshenko(supports, {end});
      if (supports == BeamSupports::free || (supports == BeamSupports::cantilever && end == 1))
        CHECK_NOTHROW(require_valid(beam));
      else
        CHECK_THROWS_WITH_AS(require_valid(beam), doctest::Contains("is a support"), std::invalid_argument);
    }
}
