#include "impulse/bodies/plate_shape.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace impulse;

namespace {

PlateShape corners(double x1, double y1, double x2, double y2, double x3, double y3, double x4, double y4) {
  return {{{{x1, y1}, {x2, y2}, {x3, y3}, {x4, y4}}}};
}

}  // namespace

TEST_CASE("a quadrilateral maps its corners and edges, and back") {
  const PlateShape shape = corners(0, 0, 2, 1, 2.5, 2.5, -0.5, 1);
  CHECK((shape.position({-1, -1}) - shape.corners[0]).norm() < 1e-15);
  CHECK((shape.position({1, -1}) - shape.corners[1]).norm() < 1e-15);
  CHECK((shape.position({1, 1}) - shape.corners[2]).norm() < 1e-15);
  CHECK((shape.position({-1, 1}) - shape.corners[3]).norm() < 1e-15);
  for (const double a : {-0.9, 0.0, 0.4, 1.0})
    for (const double b : {-1.0, -0.3, 0.8}) {
      const Eigen::Vector2d at(a, b);
      CHECK((shape.reference(shape.position(at)) - at).norm() < 1e-13);
      const double h = 1e-4;  // the map is bilinear: central differences are exact
      Eigen::Matrix2d differences;
      differences.row(0) = (shape.position({a + h, b}) - shape.position({a - h, b})) / (2 * h);
      differences.row(1) = (shape.position({a, b + h}) - shape.position({a, b - h})) / (2 * h);
      CHECK((shape.jacobian(at) - differences).norm() < 1e-11);
    }
  CHECK(rectangle(3, 2).signed_area() == 6);
  CHECK(corners(0, 0, 0, 2, 3, 2, 3, 0).signed_area() == -6);
  CHECK(rectangle(3, 2).twist().norm() == 0);
  CHECK(rectangle(3, 2).distance_to_boundary({1, 0.75}) == 0.75);
  CHECK(corners(0, 0, 0, 2, 3, 2, 3, 0).distance_to_boundary({-0.5, 1}) == -0.5);
  // Where the long edges of a trapezoid meet, its image ends.
  CHECK_THROWS_WITH((void)corners(0, -0.5, 1, -0.25, 1, 0.25, 0, 0.5).reference({2, 1}),
                    doctest::Contains("no point of the plate is at x = 2 m, y = 1 m"));
}

TEST_CASE("a quadrilateral must be convex, either way round") {
  CHECK_NOTHROW(require_valid(rectangle(1, 2)));
  CHECK_NOTHROW(require_valid(corners(0, 0, 0, 2, 3, 2, 3, 0)));
  CHECK_THROWS_WITH(require_valid(corners(0, 0, 1, 0, 0.2, 0.2, 0, 1)),
                    "corner 3 (0.2, 0.2) makes the plate concave; give a convex quadrilateral");
  CHECK_THROWS_WITH(require_valid(corners(0, 0, 0, 1, 0.2, 0.2, 1, 0)), doctest::Contains("corner 3 (0.2, 0.2)"));
  CHECK_THROWS_WITH(require_valid(corners(0, 0, 1, 0, 0.5, 0.5, 0, 1)),
                    doctest::Contains("corner 3 (0.5, 0.5) lies on the line of its neighbours"));
  CHECK_THROWS_WITH(require_valid(corners(0, 0, 1, 0, 1, 0, 0, 1)),
                    "edge 2 of the plate has no length (corners 2 and 3 coincide)");
  CHECK_THROWS_WITH(require_valid(corners(0, 0, 1, 1, 1, 0, 0, 1)),
                    "the plate's edges cross; give the corners in order round it");
  CHECK_THROWS_WITH(require_valid(corners(0, 0, 1, NAN, 1, 1, 0, 1)), "corner 2 of the plate is not finite");
}
