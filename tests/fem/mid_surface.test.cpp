#include "fem/shell/mid_surface.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

namespace impulse {
namespace {

using Eigen::Vector3d;

TEST_CASE("points of a curved panel are at the radius from its centre, x and y are lengths of arc") {
  for (const double radius : {0.5, -0.5})
    for (const Curvature curvature : {Curvature::along_x, Curvature::along_y, Curvature::both}) {
      const PanelShape shape{.length_m = 0.4, .width_m = 0.3, .curvature = curvature, .radius_m = radius};
      const HermiteNode r = mid_surface(shape, 0.1, 0.27);
      Vector3d from_centre = r.col(0) - Vector3d(0, 0, radius);
      if (curvature == Curvature::along_y) from_centre(0) = 0;
      if (curvature == Curvature::along_x) from_centre(1) = 0;
      CHECK(from_centre.norm() == about(0.5).epsilon(1e-14));
      CHECK(r.col(1).norm() == about(1).epsilon(1e-14));
      CHECK(r.col(2).norm() == about(curvature == Curvature::both ? std::cos(0.2) : 1).epsilon(1e-14));
      CHECK(mid_surface(shape, 0.2, 0.15).col(0).norm() <= 1e-16);
      // The convex side is struck: the edges are further along z than the middle.
      CHECK(r(2, 0) * radius > 0);
    }
}

TEST_CASE("derivatives are those of the place, imperfections included") {
  PanelShape shape{.length_m = 0.4, .width_m = 0.3, .curvature = Curvature::both, .radius_m = 0.5};
  shape.imperfection.waves = {{3e-3, 2, 1}};
  shape.imperfection.squared_waves = {{2e-3, 1, 2}};
  shape.imperfection.powers = {{2e-3, 0, 0}, {1e-3, 3, 1}};
  const double x = 0.07, y = 0.21, d = 1e-3;
  const auto at = [&](double i, double j) -> Vector3d { return mid_surface(shape, x + i * d, y + j * d).col(0); };
  const HermiteNode r = mid_surface(shape, x, y);
  // Fourth order: d⁴ times the fifth derivative, 30 times the frequency of the waves.
  CHECK((r.col(1) - (8 * (at(1, 0) - at(-1, 0)) - at(2, 0) + at(-2, 0)) / (12 * d)).norm() <= 1e-9);
  CHECK((r.col(2) - (8 * (at(0, 1) - at(0, -1)) - at(0, 2) + at(0, -2)) / (12 * d)).norm() <= 1e-9);
  CHECK((r.col(3) - (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4 * d * d)).norm() <= 1e-4);
}

TEST_CASE("an imperfection is along z, and in the middle as high as its amplitude") {
  PanelShape shape{.length_m = 0.4, .width_m = 0.3};
  shape.imperfection.waves = {{3e-3, 1, 1}};
  CHECK(mid_surface(shape, 0.2, 0.15)(2, 0) == about(3e-3));
  CHECK(std::abs(mid_surface(shape, 0.4, 0.1)(2, 0)) <= 1e-18);
  shape.imperfection.waves.clear();
  shape.imperfection.squared_waves = {{2e-3, 1, 1}};
  CHECK(mid_surface(shape, 0.2, 0.15)(2, 0) == about(2e-3));
  CHECK(mid_surface(shape, 0.2, 0.05)(2, 0) == about(2e-3 / 4));  // sin² 30°
  CHECK(mid_surface(shape, 0.2, 0).row(2).norm() <= 1e-18);       // neither raised nor inclined
  shape.imperfection.squared_waves.clear();
  shape.imperfection.powers = {{1e-3, 1, 2}};
  CHECK(mid_surface(shape, 0.4, 0.15)(2, 0) == about(1e-3 / 4));
}

TEST_CASE("graded lines meet the point, grow by one ratio and fill the side") {
  const std::vector<double> even = graded_lines(1, 4, 0.3, 1);
  for (std::size_t i = 0; i < 5; ++i) CHECK(even[i] == about(0.25 * static_cast<double>(i)));
  const std::vector<double> lines = graded_lines(2, 8, 1, 4);
  CHECK(lines.front() == 0);
  CHECK(lines.back() == 2);
  CHECK(lines[4] == about(1).epsilon(1e-15));
  CHECK((lines[1] - lines[0]) / (lines[4] - lines[3]) == about(4));
  CHECK((lines[2] - lines[1]) / (lines[3] - lines[2]) == about(std::pow(4.0, 1.0 / 3)));
  CHECK((lines[8] - lines[7]) / (lines[5] - lines[4]) == about(4));
  const std::vector<double> from_end = graded_lines(1, 3, 1, 9);
  CHECK((from_end[1] - from_end[0]) / (from_end[3] - from_end[2]) == about(9));
  CHECK(graded_lines(1, 5, 0.01, 2)[1] == about(0.01));
}

TEST_CASE("panels and meshes that cannot be are refused") {
  const auto valid = [](double a, double b, Curvature c, double r) {
    require_valid(PanelShape{.length_m = a, .width_m = b, .curvature = c, .radius_m = r});
  };
  CHECK_THROWS_WITH_AS(valid(0, 1, Curvature::flat, 0), "a panel's length 0 m is not positive", std::invalid_argument);
  CHECK_THROWS_WITH_AS(valid(1, -1, Curvature::flat, 0), "a panel's width -1 m is not positive", std::invalid_argument);
  CHECK_THROWS_WITH_AS(valid(1, 1, Curvature::flat, 2),
                       "a flat panel has a radius of curvature of 2 m; say along which side it is curved",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(valid(1, 1, Curvature::along_x, 0), "a curved panel's radius of curvature 0 m is not a length",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(valid(1, 1, Curvature::along_y, -0.1),
                       "the width 1 m goes round the whole circle of radius 0.1 m", std::invalid_argument);
  CHECK_THROWS_WITH_AS(valid(1, 0.1, Curvature::along_x, 0.1),
                       "the length 1 m goes round the whole circle of radius 0.1 m", std::invalid_argument);
  CHECK_THROWS_WITH_AS(valid(1, 0.1, Curvature::both, 0.3),
                       "the length 1 m goes over the poles of the sphere of "
                       "radius 0.3 m",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)graded_lines(1, 0, 0, 1), "a side without elements cannot be meshed; use at least one",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)graded_lines(1, 3, 0, 0.5), "a grading of 0.5 is not a ratio of sizes ≥ 1",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)graded_lines(1, 3, 2, 1), "the mesh is graded towards 2 m, outside the side of 1 m",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)graded_lines(1, 1, 0.5, 2),
                       "one element cannot be graded towards an inner point; use at least two", std::invalid_argument);
}

}  // namespace
}  // namespace impulse
