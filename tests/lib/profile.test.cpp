#include "lib/material/profile.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

using namespace impulse;

namespace {

doctest::Approx rounded(double value) { return doctest::Approx(value).epsilon(1e-14).scale(0); }

const Material nylon{"nylon-6", 2.8e9, 1150, std::nullopt};
const Material steel{"steel", 206e9, 7780, std::nullopt};

}  // namespace

TEST_CASE("segment: areas, impedances, mass and travel time") {
  const Segment cone{0.4, 0.03, 0.075, nylon};
  const double pi = std::numbers::pi;
  CHECK(cone.area_a_m2() == rounded(pi * 0.015 * 0.015));
  CHECK(cone.area_b_m2() == rounded(pi * 0.0375 * 0.0375));
  CHECK(cone.impedance_a_kg_per_s() == rounded(pi * 0.015 * 0.015 * std::sqrt(2.8e9 * 1150)));
  CHECK(cone.impedance_b_kg_per_s() == rounded(cone.impedance_a_kg_per_s() * 6.25));
  CHECK(cone.travel_time_s() == rounded(0.4 / std::sqrt(2.8e9 / 1150)));
  // Simpson's rule is exact for the quadratic area.
  const double middle = pi / 4 * 0.0525 * 0.0525;
  CHECK(cone.mass_kg() == rounded(1150 * 0.4 / 6 * (cone.area_a_m2() + 4 * middle + cone.area_b_m2())));
  const Segment rod{2, 0.03, 0.03, steel};
  CHECK(rod.mass_kg() == rounded(7780 * 2 * rod.area_a_m2()));
}

TEST_CASE("profile: sums and faces do not depend on the side they are seen from") {
  const Profile chain{{0.4, 0.03, 0.075, nylon}, {1.0, 0.05, 0.05, steel}};
  const Profile back = reversed(chain);
  CHECK(back[0].material.name == "steel");
  CHECK(back[1].diameter_a_m == 0.075);
  CHECK(back[1].diameter_b_m == 0.03);
  CHECK(mass_kg(back) == rounded(mass_kg(chain)));
  CHECK(travel_time_s(back) == rounded(travel_time_s(chain)));
  CHECK(face_impedance_kg_per_s(chain, Face::a) == chain[0].impedance_a_kg_per_s());
  CHECK(face_impedance_kg_per_s(chain, Face::b) == chain[1].impedance_b_kg_per_s());
  CHECK(face_impedance_kg_per_s(back, Face::b) == rounded(face_impedance_kg_per_s(chain, Face::a)));
  CHECK_THROWS_AS((void)face_impedance_kg_per_s({}, Face::a), std::invalid_argument);
}

TEST_CASE("parse_segment reads cylinders and cones") {
  const Segment cone = parse_segment("400mm,30mm,75mm,nylon-6");
  CHECK(cone.length_m == rounded(0.4));
  CHECK(cone.diameter_a_m == rounded(0.03));
  CHECK(cone.diameter_b_m == rounded(0.075));
  CHECK(cone.material.name == "nylon-6");
  const Segment rod = parse_segment("2, 0.03, 2.8GPa:1150kg/m3:0.4");
  CHECK(rod.diameter_a_m == 0.03);
  CHECK(rod.diameter_b_m == 0.03);
  CHECK(rod.material.poissons_ratio == 0.4);
}

TEST_CASE("parse_segment names the part that is wrong") {
  CHECK_THROWS_WITH_AS((void)parse_segment("400mm,30mm"), doctest::Contains("has 2 parts; expected length,diameter"),
                       std::invalid_argument);
  CHECK_THROWS_WITH((void)parse_segment("400kg,30mm,steel"),
                    "length '400kg': wrong dimension: expected a length such as 400mm");
  CHECK_THROWS_WITH((void)parse_segment("1,0,steel"), "diameter '0' is not positive");
  CHECK_THROWS_WITH((void)parse_segment("1,1,-1,steel"), "second diameter '-1' is not positive");
  CHECK_THROWS_WITH((void)parse_segment("1,1,steal"), doctest::Contains("unknown material 'steal'"));
  CHECK_THROWS_WITH((void)parse_segment("1,,steel"), doctest::Contains("diameter '': empty"));
}

TEST_CASE("require_valid names segment and value") {
  const Bar good{{{0.4, 0.03, 0.075, nylon}, {1, 0.05, 0.05, steel}}, {Face::a}, FarEnd::infinite};
  CHECK_NOTHROW(require_valid(good));
  const auto refused = [&](auto change, const char* message) {
    Bar bar = good;
    change(bar);
    CHECK_THROWS_WITH_AS(require_valid(bar), message, std::invalid_argument);
  };
  refused([](Bar& b) { b.profile.clear(); }, "a bar needs at least one segment");
  refused([](Bar& b) { b.profile[1].length_m = 0; }, "segment 2: length 0 m is not positive and finite");
  refused([](Bar& b) { b.profile[0].diameter_a_m = -1; },
          "segment 1: diameter at end A -1 m is not positive and finite");
  refused([](Bar& b) { b.profile[0].diameter_b_m = std::nan(""); },
          "segment 1: diameter at end B nan m is not positive and finite");
  refused([](Bar& b) { b.profile[1].material.youngs_modulus_Pa = std::numeric_limits<double>::infinity(); },
          "segment 2: modulus inf Pa is not positive and finite");
  refused([](Bar& b) { b.profile[1].material.density_kg_per_m3 = 0; },
          "segment 2: density 0 kg/m3 is not positive and finite");
  refused([](Bar& b) { b.faces.clear(); }, "a bar needs at least one contact face");
  refused([](Bar& b) { b.faces = {Face::b, Face::b}; }, "face B is given twice");
  refused(
      [](Bar& b) {
        b.faces = {Face::a, Face::b};
      },
      "a bar in contact at both faces has no far end to hold; leave it free");
}
