#include "lib/law/hertz.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace impulse;

namespace {

doctest::Approx rounded(double value) { return doctest::Approx(value).epsilon(1e-14).scale(0); }

Material material(double modulus_Pa, std::optional<double> ratio) { return {"tip", modulus_Pa, 7960, ratio}; }

}  // namespace

TEST_CASE("hertz_stiffness: a rigid tip of radius 9/16 m has the target's modulus") {
  // (4/3)√(9/16) = 1; an all but rigid tip contributes 1e-30/Pa.
  CHECK(hertz_stiffness(9.0 / 16, material(1e30, 0.0), 3e9) == rounded(3e9));
  CHECK(hertz_stiffness(9.0 / 4, material(1e30, 0.0), 3e9) == rounded(6e9));
  CHECK(hertz_stiffness(9.0 / 16, material(2e9, 0.5), 2e9 / 0.75) == rounded(1 / (2 * 0.75 / 2e9)));
}

TEST_CASE("hertz_stiffness: the ball of Timoshenko's problem and the ball on a laminate") {
  // Values of an independent program to five digits: half of the fifth.
  const Material ball = material(215.8e9, 0.3);
  CHECK(std::abs(hertz_stiffness(0.010, ball, contact_modulus_Pa(ball)) - 1.5810e10) < 0.5e6);
  CHECK(std::abs(hertz_stiffness(0.00635, material(210e9, 0.3), 7.9e9) - 8.1159e8) < 0.5e4);
}

TEST_CASE("hertz_stiffness: k grows with the root of the radius and changes with units as it should") {
  const double k = hertz_stiffness(0.02, material(210e9, 0.3), 70e9);
  CHECK(hertz_stiffness(0.08, material(210e9, 0.3), 70e9) == rounded(2 * k));
  CHECK(hertz_stiffness(0.02, material(420e9, 0.3), 140e9) == rounded(2 * k));
  // Tip and target may be exchanged.
  CHECK(hertz_stiffness(0.02, material(70e9, 0.0), contact_modulus_Pa(material(210e9, 0.3))) == rounded(k));
}

TEST_CASE("hertz_stiffness refuses what has no contact modulus") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS((void)hertz_stiffness(0.01, material(1e9, std::nullopt), 1e9),
                       "material 'tip' has no Poisson's ratio (a contact modulus needs it); add one, tip:0.3",
                       std::invalid_argument);
  for (const double bad : {0.0, -1.0, nan}) {
    CHECK_THROWS_WITH_AS((void)hertz_stiffness(bad, material(1e9, 0.3), 1e9), doctest::Contains("tip radius"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)hertz_stiffness(0.01, material(1e9, 0.3), bad), doctest::Contains("target modulus"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)hertz_stiffness(0.01, material(bad, 0.3), 1e9), doctest::Contains("of 'tip'"),
                         std::invalid_argument);
  }
}
