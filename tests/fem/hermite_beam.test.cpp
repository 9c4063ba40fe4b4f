#include "fem/elements/hermite_beam.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

using namespace impulse;

TEST_CASE("hermite_beam: a cantilever under force and moment, rigid motion, and shape functions") {
  const double h = 0.7, ei = 12;
  const Eigen::Matrix4d k = hermite_beam_stiffness(ei, h);
  CHECK((k - k.transpose()).norm() == 0);
  CHECK((k * Eigen::Vector4d{1, 0, 1, 0}).norm() < 1e-13 * k.norm());
  CHECK((k * Eigen::Vector4d{0, 1, h, 1}).norm() < 1e-13 * k.norm());
  const Eigen::Matrix2d tip = k.bottomRightCorner<2, 2>().inverse();
  CHECK(tip(0, 0) == about(h * h * h / (3 * ei)));
  CHECK(tip(0, 1) == about(h * h / (2 * ei)));
  CHECK(tip(1, 1) == about(h / ei));
  // Cubics are interpolated as they are: w = x³, w' = 3x².
  for (const double t : {0.0, 0.3, 0.5, 0.9, 1.0}) {
    const double x = t * h;
    CHECK(hermite_beam_shape(t, h).dot(Eigen::Vector4d{0, 0, h * h * h, 3 * h * h}) == about(x * x * x));
    CHECK(hermite_beam_shape(t, h).dot(Eigen::Vector4d{1, 0, 1, 0}) == about(1).epsilon(1e-15));
  }
}

TEST_CASE("hermite_beam: the consistent mass is the integral of the shape functions") {
  const double h = 0.7, mu = 3;
  const Eigen::Matrix4d m = hermite_beam_consistent_mass(mu, h);
  // Simpson's sums on 400 intervals are exact for sextics to (1/400)⁴.
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (int i = 0; i <= 400; ++i) {
    const Eigen::Vector4d n = hermite_beam_shape(i / 400.0, h);
    sum += (i == 0 || i == 400 ? 1 : i % 2 == 1 ? 4 : 2) * n * n.transpose();
  }
  CHECK((m - mu * h / 1200 * sum).norm() < 1e-9 * m.norm());
  CHECK(Eigen::Vector4d(1, 0, 1, 0).dot(m * Eigen::Vector4d(1, 0, 1, 0)) == about(mu * h));
  // Turning about one end: mass moment μh³/3.
  CHECK(Eigen::Vector4d(0, 1, h, 1).dot(m * Eigen::Vector4d(0, 1, h, 1)) == about(mu * h * h * h / 3));
}
