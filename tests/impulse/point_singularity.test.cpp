#include "impulse/bodies/point_singularity.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace impulse;

namespace {

constexpr double pi = std::numbers::pi;
using Derivatives = Eigen::Matrix<double, 3, derivative_count>;

Laminate of(const char* layup) { return laminate(layers_of(layup, {"test", 40, 1, 0.25, 0.6, 0.6, 0.5, 1}, 0.02)); }

/// (N, M) of displacements.
Eigen::Matrix<double, 6, 1> resultants(const Laminate& l, const Derivatives& f) {
  const Eigen::Vector3d strain(f(0, 1), f(1, 2), f(0, 2) + f(1, 1)), curvature(-f(2, 3), -f(2, 5), -2 * f(2, 4));
  Eigen::Matrix<double, 6, 1> result;
  result << l.extension * strain + l.coupling * curvature, l.coupling * strain + l.bending * curvature;
  return result;
}

}  // namespace

TEST_CASE("an isotropic plate's singularity is r² ln r / 8πD, up to r²") {
  Laminate plate;
  plate.extension << 1, 0.3, 0, 0.3, 1, 0, 0, 0, 0.35;
  plate.bending = 2 * plate.extension;
  const PointSingularity singularity(plate);
  const auto same = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const auto closed = [](const Eigen::Vector2d& x) { return x.squaredNorm() * std::log(x.norm()) / (16 * pi); };
    const double quadratic = singularity.at(a)(2, 0) - closed(a);
    CHECK(quadratic / a.squaredNorm() == about((singularity.at(b)(2, 0) - closed(b)) / b.squaredNorm()).epsilon(1e-12));
  };
  same({0.1, 0.2}, {2, -1});
  same({3, 0}, {0, 1e-3});
  CHECK_THROWS_WITH((void)singularity.at({0, 0}), "at the force itself the curvature is infinite");
}

TEST_CASE("the singularity of any laminate is in equilibrium with a unit force, and its derivatives are derivatives") {
  for (const char* layup : {"[0]", "[30]", "[0/90]", "[45/-45]", "[10/60/-20]"}) {
    CAPTURE(layup);
    const Laminate l = of(layup);
    const PointSingularity singularity(l);
    const double h = 1e-4;
    const auto difference = [&](const Eigen::Vector2d& at, const Eigen::Vector2d& along, auto&& of_derivatives) {
      return ((of_derivatives(singularity.at(at + h * along)) - of_derivatives(singularity.at(at - h * along))) /
              (2 * h))
          .eval();
    };
    const auto everything = [](const Derivatives& f) { return f; };
    const auto loads = [&](const Derivatives& f) { return resultants(l, f); };
    double pulled = 0;
    const int points = 400;
    for (int k = 0; k < points; ++k) {
      const double angle = 2 * pi * k / points;
      const Eigen::Vector2d n(std::cos(angle), std::sin(angle)), at = 0.3 * n;
      const Derivatives f = singularity.at(at), x = difference(at, {1, 0}, everything),
                        y = difference(at, {0, 1}, everything);
      const double size = f.row(2).tail<3>().norm();
      CHECK((x.col(0) - f.col(1)).norm() + (y.col(0) - f.col(2)).norm() < 1e-6 * size);
      CHECK(std::abs(x(2, 1) - f(2, 3)) + std::abs(y(2, 1) - f(2, 4)) + std::abs(y(2, 2) - f(2, 5)) < 1e-5 * size);
      const Eigen::Matrix<double, 6, 1> r_x = difference(at, {1, 0}, loads), r_y = difference(at, {0, 1}, loads);
      const double scale = (r_x.norm() + r_y.norm()) * 1e-5;
      CHECK(std::abs(r_x(0) + r_y(2)) < scale);
      CHECK(std::abs(r_x(2) + r_y(1)) < scale);
      pulled += 0.3 * 2 * pi / points * n.dot(Eigen::Vector2d(r_x(3) + r_y(5), r_x(5) + r_y(4)));
    }
    CHECK(pulled == about(-1).epsilon(1e-5));  // the shear forces round a circle carry the force
  }
}
