#include "fem/bodies/plane_stress_structure.hpp"

#include "lib/model/modal_model.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace impulse;

namespace {

/// NAFEMS FV32: a membrane 10 m long that tapers from 5 m, where it is clamped, to 1 m.
Sheet tapered(std::size_t along, std::size_t across, Quadrilateral kind) {
  Sheet sheet;
  sheet.mesh.corners << 0, -2.5, 10, -0.5, 10, 0.5, 0, 2.5;
  sheet.mesh.along = along;
  sheet.mesh.across = across;
  sheet.material = parse_material("200GPa:8000kg/m3:0.3");
  sheet.thickness_m = 0.05;
  sheet.element = kind;
  for (std::size_t j = 0; j <= across; ++j)
    for (const Eigen::Index d : {0, 1}) sheet.held.push_back(2 * sheet.mesh.node(0, j) + d);
  return sheet;
}

Eigen::VectorXd frequencies_Hz(const Sheet& sheet, std::size_t count) {
  const Eigen::MatrixXd none(2 * sheet.mesh.node_count(), 0);
  return modal_model(plane_stress_structure(sheet, none), {.mode_count = count}).angular_frequency /
         (2 * std::numbers::pi);
}

const Eigen::VectorXd fv32{{44.617, 130.010, 162.689, 245.987, 379.718, 391.405}};  // converged plane stress

}  // namespace

TEST_CASE("plane_stress_structure: NAFEMS FV32, the rows of the plain bilinear element to 1e-4") {
  const Eigen::VectorXd coarse{{44.905, 132.116, 162.832, 252.990, 393.315, 396.263}};
  const Eigen::VectorXd fine{{44.692, 130.549, 162.728, 247.769, 383.915, 391.895}};
  const Eigen::VectorXd by_16 = frequencies_Hz(tapered(16, 8, Quadrilateral::bilinear), 6);
  const Eigen::VectorXd by_32 = frequencies_Hz(tapered(32, 16, Quadrilateral::bilinear), 6);
  for (Eigen::Index i = 0; i < 6; ++i) {
    CHECK(by_16(i) == about(coarse(i)).epsilon(1e-4));
    CHECK(by_32(i) == about(fine(i)).epsilon(1e-4));
  }
}

TEST_CASE("plane_stress_structure: NAFEMS FV32 on ever finer meshes") {
  const Eigen::VectorXd nafems{{44.623, 130.03, 162.70, 246.05, 379.90, 391.44}};
  for (const Quadrilateral kind : {Quadrilateral::bilinear, Quadrilateral::incompatible}) {
    std::vector<double> errors;
    for (const std::size_t across : {4u, 8u, 16u}) {
      const Eigen::VectorXd f = frequencies_Hz(tapered(2 * across, across, kind), 6);
      errors.push_back(((f - fv32).array() / fv32.array()).abs().maxCoeff());
      if (across == 16) CHECK(((f - nafems).array() / nafems.array()).abs().maxCoeff() < 0.012);
    }
    // Order 2, less what the singularity at the clamped corners takes.
    CHECK(errors[0] / errors[1] > 2.5);
    CHECK(errors[1] / errors[2] > 3);
  }
  const Eigen::VectorXd finest = frequencies_Hz(tapered(64, 32, Quadrilateral::incompatible), 6);
  CHECK(((finest - fv32).array() / fv32.array()).abs().maxCoeff() < 3e-3);
}

TEST_CASE("plane_stress_structure: a free sheet weighs what it weighs, with either mass, and only moves rigidly") {
  for (const MassMatrix mass : {MassMatrix::lumped, MassMatrix::consistent}) {
    Sheet sheet = tapered(5, 3, Quadrilateral::incompatible);
    sheet.held.clear();
    sheet.mass = mass;
    const Structure body = plane_stress_structure(sheet, Eigen::MatrixXd::Zero(2 * sheet.mesh.node_count(), 1));
    CHECK(body.mass.sum() == about(2 * 8000 * 0.05 * 30).epsilon(1e-13));
    CHECK(body.mass.nonZeros() == (mass == MassMatrix::lumped ? body.mass.rows() : body.mass.nonZeros()));
    const ModalModel model = modal_model(body, {.mode_count = 4});
    CHECK(model.angular_frequency.head(3).isZero(0));
    CHECK(model.angular_frequency(3) > 100);
  }
}

TEST_CASE("plane_stress_structure: refuses what is no sheet") {
  const auto refuses = [](auto change, const char* message) {
    Sheet sheet = tapered(4, 2, Quadrilateral::bilinear);
    change(sheet);
    CHECK_THROWS_WITH_AS((void)plane_stress_structure(sheet, Eigen::MatrixXd::Zero(2 * sheet.mesh.node_count(), 1)),
                         doctest::Contains(message), std::invalid_argument);
  };
  refuses([](Sheet& s) { s.mesh.along = 0; }, "a mesh of 0 x 2 elements has none");
  refuses([](Sheet& s) { s.thickness_m = 0; }, "thickness 0 m is not positive");
  refuses([](Sheet& s) { s.material.density_kg_per_m3 = 0; }, "density 0 kg/m3 is not positive");
  refuses([](Sheet& s) { s.material.poissons_ratio.reset(); }, "needs Poisson's ratio");
  CHECK_THROWS_WITH_AS(
      (void)plane_stress_structure(tapered(4, 2, Quadrilateral::bilinear), Eigen::MatrixXd::Zero(7, 1)),
      "functionals of 7 rows for 30 degrees of freedom", std::invalid_argument);
  Sheet huge = tapered(4, 2, Quadrilateral::bilinear);
  huge.mesh.along = huge.mesh.across = 2000;
  CHECK_THROWS_WITH_AS((void)plane_stress_structure(huge, Eigen::MatrixXd::Zero(1, 1)),
                       doctest::Contains("2000 x 2000 elements are more"), std::invalid_argument);
}
