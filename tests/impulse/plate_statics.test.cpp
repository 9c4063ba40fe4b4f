#include "impulse/exact/plate_statics.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace impulse;

namespace {

constexpr double pi = std::numbers::pi;

Laminate of(const std::string& layup) {
  return laminate(layers_of(layup, {"test", 40, 1, 0.25, 0.6, 0.6, 0.5, 1}, 0.02));
}

}  // namespace

TEST_CASE("Lévy's single series is Navier's double one") {
  const double a = 3, b = 2;
  const Eigen::Vector2d force(1.1, 0.7), point(1.9, 1.3);
  for (const char* layup : {"[0/90/0]", "[90]", "[0]"}) {
    const Laminate plate = of(layup);
    const Eigen::Matrix3d& d = plate.bending;
    double w = 0;
    Eigen::Vector3d curvature = Eigen::Vector3d::Zero();
    for (int m = 1; m < 500; ++m)
      for (int n = 1; n < 500; ++n) {
        const double p = m * pi / a, q = n * pi / b;
        // The curvatures converge conditionally; smoothed sums leave 1e-4, and of w less.
        const double smooth = std::exp(-12 * std::pow(m / 500.0, 4)) * std::exp(-12 * std::pow(n / 500.0, 4));
        const double term =
            smooth * 4 / (a * b) * std::sin(p * force.x()) * std::sin(q * force.y()) /
            (d(0, 0) * std::pow(p, 4) + 2 * (d(0, 1) + 2 * d(2, 2)) * p * p * q * q + d(1, 1) * std::pow(q, 4));
        const double wave = term * std::sin(p * point.x()) * std::sin(q * point.y());
        w += wave;
        curvature += Eigen::Vector3d(p * p * wave, q * q * wave,
                                     -2 * p * q * term * std::cos(p * point.x()) * std::cos(q * point.y()));
      }
    const PlateStatics levy = simply_supported_plate_statics(plate, a, b, force, point);
    CAPTURE(layup);
    CHECK(levy.deflection_m_per_N == about(w).epsilon(1e-6));
    CHECK((levy.curvature_per_Nm - curvature).norm() < 1e-4 * curvature.norm());
  }
}

TEST_CASE("an isotropic plate's equal roots: a square's middle under a force in its middle") {
  Laminate plate;
  plate.bending << 1, 0.3, 0, 0.3, 1, 0, 0, 0, 0.35;
  // Timoshenko's 0.01160 P a²/D, approached from beside the force.
  CHECK(simply_supported_plate_statics(plate, 1, 1, {0.5, 0.5}, {0.5, 0.501}).deflection_m_per_N ==
        about(0.01160).epsilon(1e-3));
  // A plate of two equal axes does not know which is which.
  const PlateStatics one = simply_supported_plate_statics(plate, 1, 1, {0.4, 0.3}, {0.7, 0.8});
  const PlateStatics other = simply_supported_plate_statics(plate, 1, 1, {0.3, 0.4}, {0.8, 0.7});
  CHECK(one.deflection_m_per_N == about(other.deflection_m_per_N).epsilon(1e-7));
  CHECK(one.curvature_per_Nm(0) == about(other.curvature_per_Nm(1)).epsilon(1e-6));
  CHECK(one.curvature_per_Nm(2) == about(other.curvature_per_Nm(2)).epsilon(1e-6));
}

TEST_CASE("Navier's plate refuses what it isn't") {
  CHECK_THROWS_WITH((void)simply_supported_plate_statics(of("[30]"), 1, 1, {0.5, 0.5}, {0.5, 0.6}),
                    doctest::Contains("is specially orthotropic"));
  CHECK_THROWS_WITH((void)simply_supported_plate_statics(of("[0]"), 1, 1, {0.5, 0.5}, {0.5, 1.6}),
                    doctest::Contains("(0.5 m, 1.6 m) is outside"));
  CHECK_THROWS_WITH((void)simply_supported_plate_statics(of("[0]"), 1, 1, {0.5, 0.5}, {0.6, 0.5}),
                    doctest::Contains("don't converge"));
}
