#include "impulse/bodies/point_flexibility.hpp"

#include "lib/model/modal_model.hpp"
#include "lib/numerics/dense_algebra.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace impulse;

namespace {

Plate panel(const char* edges) {
  Plate plate;
  plate.shape = rectangle(3, 2);
  plate.laminate = laminate(layers_of("[0/90/0]", {"test", 40, 1, 0.25, 0.6, 0.6, 0.5, 1}, 0.02));
  plate.theory = Plate::Theory::thin;
  plate.edges = parse_plate_edges(edges);
  return plate;
}

double truncated(const RitzPlate& plate, const Eigen::Vector2d& at) {
  const Eigen::VectorXd load = plate.deflection(at);
  return load.dot(DenseCholesky::of(plate.structure().stiffness)->solve(load).col(0));
}

}  // namespace

TEST_CASE("a thin plate's flexibility under a point force is Navier's once the missing part is added") {
  const Plate plate = panel("WWWW");
  const Eigen::Matrix3d& d = plate.laminate.bending;
  const Eigen::Vector2d middle(0, 0), beside(0.3, -0.2);
  for (const Eigen::Vector2d& at : {middle, beside}) {
    const double x = (at.x() + 1) / 2, y = (at.y() + 1) / 2;
    // The series' remainder falls like 1/m², alike in both directions: extrapolated from 400 and 800 terms.
    const auto navier = [&](int terms) {
      double sum = 0;
      for (int m = 1; m < terms; ++m)
        for (int n = 1; n < terms; ++n) {
          const double a = m * std::numbers::pi / 3, b = n * std::numbers::pi / 2;
          const double w = std::sin(m * std::numbers::pi * x) * std::sin(n * std::numbers::pi * y);
          sum += 4 * w * w / 6 /
                 (d(0, 0) * std::pow(a, 4) + 2 * (d(0, 1) + 2 * d(2, 2)) * a * a * b * b + d(1, 1) * std::pow(b, 4));
        }
      return sum;
    };
    const double exact = (4 * navier(801) - navier(401)) / 3;
    double before = 1;
    for (const std::size_t terms : {12, 16, 24}) {
      const RitzPlate ritz(plate, terms);
      const double plain = truncated(ritz, at), whole = plain + missing_point_flexibility(ritz, {at})(0);
      CAPTURE(terms);
      const double error = std::abs(whole / exact - 1);
      CHECK(error < 0.2 * std::abs(plain / exact - 1));
      CHECK(error < before);
      before = error;
    }
    CHECK(before < 5e-4);
  }
}

TEST_CASE("a free plate misses about as much as a held one: the force's neighbourhood") {
  const double held = missing_point_flexibility(RitzPlate(panel("CCCC"), 16), {{0, 0}})(0);
  const double free = missing_point_flexibility(RitzPlate(panel("FFFF"), 16), {{0, 0}})(0);
  CHECK(free == doctest::Approx(held).epsilon(0.5));
  CHECK(missing_point_flexibility(RitzPlate(panel("CCCC"), 7), {{0, 0}})(0) == 0);
  Plate shear = panel("CCCC");
  shear.theory = Plate::Theory::shear;
  CHECK_THROWS_WITH((void)missing_point_flexibility(RitzPlate(shear, 8), {{0, 0}}),
                    "a point force on a shear-deformable plate has no limit");
}
