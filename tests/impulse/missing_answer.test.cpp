#include "impulse/bodies/missing_answer.hpp"

#include "impulse/exact/plate_statics.hpp"
#include "lib/model/modal_model.hpp"
#include "lib/numerics/dense_algebra.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <utility>

using namespace impulse;

namespace {

Plate panel(const char* edges, const char* layup = "[0/90/0]") {
  Plate plate;
  plate.shape = rectangle(3, 2);
  plate.laminate = laminate(layers_of(layup, {"test", 40, 1, 0.25, 0.6, 0.6, 0.5, 1}, 0.02));
  plate.theory = Plate::Theory::thin;
  plate.edges = parse_plate_edges(edges);
  return plate;
}

/// Deflection and strains (z = 0.01) at a point under a unit force, of the series and of all; a free plate's elastic
/// part, the inertia relieved.
struct Answer {
  Eigen::Vector4d series, whole;
};

Answer answer(const Plate& plate, std::size_t terms, const Eigen::Vector2d& force, const Eigen::Vector2d& point) {
  const RitzPlate ritz(plate, terms);
  DenseStructure body = ritz.structure();
  body.contacts = ritz.deflection(force);
  body.outputs.resize(ritz.unknown_count(), 4);
  body.outputs << ritz.deflection(point), ritz.strains(point, 0.01);
  Answer result;
  if (plate.edges[0].deflection) {
    result.series = body.outputs.transpose() * DenseCholesky::of(body.stiffness)->solve(body.contacts);
  } else {
    const ModalModel modes = modal_model(body, {.mode_count = 7, .residual = ModalOptions::Residual::attached});
    result.series = modes.residual_outputs.col(0);
    for (Eigen::Index i = 0; i < modes.mode_count(); ++i)
      if (modes.angular_frequency(i) > 0)
        result.series += modes.output_participation.row(i).transpose() * modes.participation(i, 0) /
                         std::pow(modes.angular_frequency(i), 2);
  }
  const MissingAnswer missing(ritz, body, {force});
  result.whole = result.series;
  result.whole(0) += missing.deflection(point)(0);
  result.whole.tail<3>() += missing.strains(point, 0.01).col(0);
  return result;
}

/// Largest difference, of strains against the largest of them.
double apart(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
  return std::max(std::abs(a(0) / b(0) - 1), (a - b).tail<3>().norm() / b.tail<3>().norm());
}

}  // namespace

TEST_CASE("strains under a point force: Navier's, which the series alone miss") {
  for (const char* layup : {"[0]", "[0/90/0]", "[90/0/90]"})
    for (const auto& [force, point] : {std::pair(Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 0.5)),
                                       std::pair(Eigen::Vector2d(0.3, -0.2), Eigen::Vector2d(0.6, 0.2))}) {
      CAPTURE(layup);
      const Plate plate = panel("WWWW", layup);
      const PlateStatics exact = simply_supported_plate_statics(plate.laminate, 3, 2, plate.shape.position(force),
                                                                plate.shape.position(point));
      Eigen::Vector4d expected;
      expected << exact.deflection_m_per_N, 0.01 * exact.curvature_per_Nm;
      double before = 1;
      for (const std::size_t terms : {12, 16}) {
        const Answer a = answer(plate, terms, force, point);
        const double error = apart(a.whole, expected);
        CHECK(error < 0.1 * apart(a.series, expected));
        CHECK(error < 0.5 * before);
        before = error;
      }
      CHECK(before < 1e-3);  // powers of the distance of the force's images, which are nearest in the stiff direction
    }
}

TEST_CASE("a thin plate's flexibility under a point force is Navier's once the missing part is added") {
  const Plate plate = panel("WWWW");
  const Eigen::Matrix3d& d = plate.laminate.bending;
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.3, -0.2)}) {
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
    for (const std::size_t terms : {12, 16}) {
      const RitzPlate ritz(plate, terms);
      const DenseStructure body = ritz.structure();
      const Eigen::VectorXd load = ritz.deflection(at);
      const double series = load.dot(DenseCholesky::of(body.stiffness)->solve(load).col(0));
      const double whole = series + MissingAnswer(ritz, body, {at}).flexibility()(0, 0);
      CAPTURE(terms);
      CHECK(whole == about(exact).epsilon(terms == 12 ? 1e-4 : 2e-5));
      CHECK(std::abs(series / exact - 1) > 1e-3);
    }
  }
}

TEST_SUITE("slow") {
  TEST_CASE("a plate of any kind under a point force: its answer converges though its series do not") {
    const auto converges = [](const char* what, const Plate& plate, std::size_t terms = 11) {
      const Eigen::Vector2d force(0.2, -0.1), point(-0.1, 0.5);
      const Answer coarse = answer(plate, terms, force, point), fine = answer(plate, terms + 4, force, point);
      INFO(what, ": ", apart(coarse.whole, fine.whole), " and the series ", apart(fine.series, fine.whole));
      CHECK(apart(coarse.whole, fine.whole) < 5e-3);
      CHECK(apart(fine.series, fine.whole) > 3e-3);
      CHECK(apart(coarse.whole, fine.whole) < 0.25 * apart(fine.series, fine.whole));
    };
    converges("clamped", panel("CCCC", "[30/-50/0]s"));
    converges("unsymmetric", panel("IIII", "[30/-50]"));
    converges("free", panel("FFFF", "[0/90/0]"));
    converges("free and unsymmetric", panel("FFFF", "[0/90]"));
    Plate plate = panel("CICI", "[45/-45]s");
    plate.curvature_per_m = 0.03;  // √(Rh) is 0.8 m, a scale of its own
    converges("curved", plate, 14);
    plate = panel("CCCC", "[0/60/-60]s");
    plate.shape = {{{{0, 0}, {3, 0}, {3.8, 2}, {1, 2.2}}}};
    converges("any quadrilateral", plate);
    plate = panel("FFFF", "[0/90/0]");
    const double d = plate.laminate.bending(0, 0);
    plate.springs.fill({20 * d, 0, 0, 3 * d, 0});
    converges("on springs", plate);
  }
}

TEST_CASE("missing flexibilities of two forces are reciprocal, and shear theory has none") {
  const RitzPlate ritz(panel("CFSW", "[20/-60]s"), 12);
  const MissingAnswer missing(ritz, ritz.structure(), {{0, 0}, {0.3, 0.4}});
  const double scale = missing.flexibility()(0, 0);
  CHECK(scale > 0);
  CHECK(missing.deflection({0, 0})(1) == about(missing.deflection({0.3, 0.4})(0)).epsilon(0.05));
  Plate shear = panel("CCCC");
  shear.theory = Plate::Theory::shear;
  const RitzPlate thick(shear, 8);
  CHECK_THROWS_WITH(MissingAnswer(thick, thick.structure(), {{0, 0}}),
                    "a point force on a shear-deformable plate has no limit");
}
