#include "fem/shell/shell.hpp"

#include "lib/model/modal_model.hpp"
#include "tests/support/about.hpp"
#include "tests/support/shells.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace impulse {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using shells::panel;
using shells::rest;

/// Anisotropic and unsymmetric, so that no coupling is missed; positive definite.
Laminate general_laminate() {
  Laminate laminate = shells::isotropic(70e9, 0.3, 2e-3, 2700);
  laminate.extension(0, 0) *= 1.7;
  laminate.extension(0, 2) = laminate.extension(2, 0) = 2e7;
  laminate.coupling << 3e4, 1e4, -2e3, 1e4, -2e4, 4e3, -2e3, 4e3, 1e4;
  laminate.bending(1, 1) *= 1.3;
  laminate.bending(1, 2) = laminate.bending(2, 1) = 4;
  return laminate;
}

/// Doubly curved, imperfect and graded.
ShellPanel rough_panel(const std::string& edges = "FFFF") {
  PanelShape shape{.length_m = 0.3, .width_m = 0.2, .curvature = Curvature::both, .radius_m = 0.4};
  shape.imperfection.waves = {{4e-3, 1, 2}};
  shape.imperfection.powers = {{2e-3, 2, 1}};
  return {shape, general_laminate(), parse_edges(edges), graded_lines(0.3, 4, 0.1, 2), graded_lines(0.2, 3, 0.2, 1.5)};
}

VectorXd random_displacement(const Shell& shell, double amplitude_m) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  VectorXd values(shell.nodal_values(rest(shell)).size());
  const double scale[4] = {1, 20, 20, 400};
  for (Eigen::Index i = 0; i < values.size(); ++i) values(i) = amplitude_m * scale[i % 4] * uniform(generator);
  return shell.restrained(values);
}

/// Nodal values of u(r) = motion(r) - r for an affine motion: the panel's surface is in the space of displacements.
template <class Motion>
VectorXd motion_of(const Shell& shell, const Motion& linear, const Vector3d& shift) {
  VectorXd values = VectorXd::Zero(shell.nodal_values(rest(shell)).size());
  for (const ShellElement& element : shell.elements())
    for (std::size_t k = 0; k < 16; ++k) {
      const Vector3d r = element.surface.row(static_cast<Eigen::Index>(k)).transpose() / element.scale[k];
      Vector3d u = linear * r - r;
      if (element.dof[k] % 4 == 0) u += shift;
      for (int c = 0; c < 3; ++c) values(element.dof[k] + 4 * c) = u(c);
    }
  return shell.restrained(values);
}

TEST_CASE("the internal force is the derivative of the energy, and the tangent that of the force") {
  const Shell shell(rough_panel("FCTI"));
  const VectorXd z = random_displacement(shell, 2e-3), direction = random_displacement(shell, 1e-3).reverse();
  const Eigen::SparseMatrix<double> tangent = shell.tangent(z);
  CHECK((tangent - Eigen::SparseMatrix<double>(tangent.transpose())).norm() == 0);
  // Central differences of a quartic: the error is e²f'''/6 exactly, so Richardson's extrapolation leaves rounding.
  const auto force_slope = [&](double e) -> VectorXd {
    return (shell.internal(z + e * direction).force - shell.internal(z - e * direction).force) / (2 * e);
  };
  const VectorXd slope = (4 * force_slope(5e-4) - force_slope(1e-3)) / 3;
  CHECK((tangent * direction - slope).norm() <= 1e-10 * slope.norm());
  const auto energy_slope = [&](double e) {
    return (shell.internal(z + e * direction).energy_J - shell.internal(z - e * direction).energy_J) / (2 * e);
  };
  const double work = shell.internal(z).force.dot(direction);
  CHECK(work == about((4 * energy_slope(5e-4) - energy_slope(1e-3)) / 3).epsilon(1e-10));
}

TEST_CASE("the energy is a quartic polynomial of the displacement") {
  const Shell shell(rough_panel());
  const VectorXd z = random_displacement(shell, 2e-3);
  // The fifth difference of a quartic vanishes.
  double difference = 0, scale = 0;
  const double binomial[6] = {-1, 5, -10, 10, -5, 1};
  for (int k = 0; k < 6; ++k) {
    const double energy = shell.internal(0.3 * k * z).energy_J;
    difference += binomial[k] * energy;
    scale = std::max(scale, energy);
  }
  CHECK(std::abs(difference) <= 1e-12 * scale);
}

TEST_CASE("small rigid motions leave a curved imperfect panel without force") {
  const Shell shell(rough_panel());
  const Eigen::SparseMatrix<double> stiffness = shell.tangent(rest(shell));
  for (int k = 0; k < 3; ++k) {
    const VectorXd shifted = motion_of(shell, Eigen::Matrix3d::Identity(), Vector3d::Unit(k));
    CHECK((stiffness * shifted).norm() <= 1e-12 * stiffness.norm() * shifted.norm());
    Eigen::Matrix3d spin = Eigen::Matrix3d::Identity();
    spin((k + 1) % 3, k) = 1;
    spin(k, (k + 1) % 3) = -1;
    const VectorXd turned = motion_of(shell, spin, Vector3d::Zero());
    CHECK((stiffness * turned).norm() <= 1e-12 * stiffness.norm() * turned.norm());
  }
}

TEST_CASE("a finite rotation strains no membrane") {
  const Shell shell(rough_panel());
  const Eigen::AngleAxisd rotation(0.7, Vector3d(1, -2, 0.5).normalized());
  const VectorXd z = motion_of(shell, rotation.toRotationMatrix(), Vector3d(0.1, 0.2, 0.3));
  for (const PanelPoint point : {PanelPoint{0.05, 0.02}, PanelPoint{0.2, 0.17}, PanelPoint{0.3, 0.2}})
    CHECK(shell.strain(z, point).membrane.norm() <= 1e-14);
}

TEST_CASE("patch test: any constant state of plane strain and of curvature is exact in a graded mesh") {
  PanelShape shape{.length_m = 0.3, .width_m = 0.2};
  const Shell shell(
      {shape, general_laminate(), parse_edges("FFFF"), graded_lines(0.3, 4, 0.1, 2), graded_lines(0.2, 3, 0.2, 1.5)});
  for (int state = 0; state < 6; ++state) {
    Eigen::Matrix<double, 6, 1> strain = Eigen::Matrix<double, 6, 1>::Zero();
    strain(state) = 1e-3;
    VectorXd values = VectorXd::Zero(shell.nodal_values(rest(shell)).size());
    for (const ShellElement& element : shell.elements())
      for (std::size_t b = 0; b < 4; b += 2)
        for (std::size_t a = 0; a < 4; a += 2) {
          const Vector3d r = element.surface.row(static_cast<Eigen::Index>(4 * b + a));
          const double x = r(0), y = r(1);
          const int dof = element.dof[4 * b + a];
          values.segment<4>(dof) << strain(0) * x + strain(2) * y / 2, strain(0), strain(2) / 2, 0;
          values.segment<4>(dof + 4) << strain(1) * y + strain(2) * x / 2, strain(2) / 2, strain(1), 0;
          values.segment<4>(dof + 8) << -(strain(3) * x * x + strain(4) * y * y + strain(5) * x * y) / 2,
              -strain(3) * x - strain(5) * y / 2, -strain(4) * y - strain(5) * x / 2, -strain(5) / 2;
        }
    const VectorXd z = shell.restrained(values);
    const Eigen::SparseMatrix<double> stiffness = shell.tangent(rest(shell));
    Matrix6d c;
    const Laminate laminate = general_laminate();
    c << laminate.extension, laminate.coupling, laminate.coupling, laminate.bending;
    CHECK(z.dot(stiffness * z) == about(0.06 * strain.dot(c * strain)).epsilon(1e-12));
    // No force on any degree of freedom that no edge touches.
    const VectorXd force = stiffness * z;
    double inner = 0;
    for (Eigen::Index node : {6, 7, 8, 11, 12, 13}) inner = std::max(inner, force.segment(12 * node, 12).norm());
    CHECK(inner <= 1e-12 * force.norm());
  }
}

TEST_CASE(
    "a cylinder that breathes has the energy of its hoop strain w/R and its change of curvature w/R², to order 4") {
  const double radius = 0.2, modulus = 70e9, thickness = 1e-3, w = 1e-6;
  PanelShape shape{.length_m = 0.1, .width_m = 0.15, .curvature = Curvature::along_y, .radius_m = radius};
  const double strain = w / radius, bending = w / (radius * radius);
  const double exact =
      0.015 / 2 * modulus * (thickness * strain * strain + std::pow(thickness, 3) / 12 * bending * bending);
  std::vector<double> errors;
  for (const std::size_t count : {1, 2, 4, 8}) {
    const Shell shell(panel(shape, shells::isotropic(modulus, 0, thickness, 2700), "YYYY", 1, count));
    VectorXd values = VectorXd::Zero(shell.nodal_values(rest(shell)).size());
    for (std::size_t node = 0; node < 2 * (count + 1); ++node) {
      const double angle = (shell.panel().lines_y[node / 2] - 0.075) / radius;
      const auto dof = static_cast<Eigen::Index>(12 * node);
      values.segment<4>(dof + 4) << -std::sin(angle), 0, -std::cos(angle) / radius, 0;
      values.segment<4>(dof + 8) << std::cos(angle), 0, -std::sin(angle) / radius, 0;
    }
    const VectorXd z = shell.restrained(w * values);
    errors.push_back(std::abs(0.5 * z.dot(shell.tangent(rest(shell)) * z) / exact - 1));
  }
  for (std::size_t i = 1; i < errors.size(); ++i)
    CHECK(std::log2(errors[i - 1] / errors[i]) == about(4).epsilon(0.1 / 4));
}

TEST_CASE("the mass is the panel's, and a rigid motion has its kinetic energy") {
  const double h = 3e-3;
  PanelShape shape{.length_m = 0.3, .width_m = 0.2, .curvature = Curvature::along_x, .radius_m = -0.5};
  const Shell shell(panel(shape, shells::isotropic(70e9, 0.3, h, 2700), "FFFF", 4, 3));
  const Eigen::SparseMatrix<double> mass = shell.mass();
  for (int k = 0; k < 3; ++k) {
    const VectorXd shifted = motion_of(shell, Eigen::Matrix3d::Identity(), Vector3d::Unit(k));
    // The interpolated arc differs from the true one by the fourth power of an element's 0.15 rad, times 1/720.
    CHECK(shifted.dot(mass * shifted) == about(2700 * h * 0.06).epsilon(1e-6));
  }
}

TEST_CASE("a functional reads the displacement at a point, and a uniform load works as its resultant") {
  const Shell shell(rough_panel());
  const VectorXd z = random_displacement(shell, 1e-3);
  const PanelPoint point{0.123, 0.077};
  const Vector3d direction(0.2, -0.5, 1);
  CHECK(shell.displacement_functional(point, direction).dot(z) ==
        about(direction.dot(shell.displacement(z, point))).epsilon(1e-13));
  const VectorXd shifted = motion_of(shell, Eigen::Matrix3d::Identity(), direction);
  const double area =
      shifted.dot(shell.mass() * shifted) / direction.squaredNorm() / shell.panel().laminate.mass_kg_per_m2;
  CHECK(shell.uniform_load(Vector3d(3, 4, 5)).dot(shifted) ==
        about(area * direction.dot(Vector3d(3, 4, 5))).epsilon(1e-13));
}

TEST_CASE("a free curved panel has six rigid-body modes") {
  PanelShape shape{.length_m = 0.3, .width_m = 0.2, .curvature = Curvature::both, .radius_m = 0.4};
  const Shell shell(panel(shape, general_laminate(), "FFFF", 3, 3));
  const ModalModel modes = modal_model(shell_structure(shell, {{0.15, 0.1}}), {.mode_count = 10});
  CHECK((modes.angular_frequency.array() == 0).count() == 6);
}

TEST_CASE("shell: a panel that nothing holds flies as its mass, along the normal of its first point") {
  const PanelShape shape{.length_m = 0.2, .width_m = 0.1, .curvature = Curvature::along_y, .radius_m = 0.15};
  const Shell shell(shells::panel(shape, shells::isotropic(70e9, 0.3, 2e-3, 2700), "FFFF", 3, 2));
  const Structure body = shell_structure(shell, {{0.1, 0.05}, {0.05, 0.02}});
  const Eigen::VectorXd& r = body.translation;
  REQUIRE(r.size() == shell.size());
  CHECK(body.contacts.col(0).dot(r) == about(1).epsilon(1e-12));
  // The other normal is turned against the first by the arc between them.
  CHECK(body.contacts.col(1).dot(r) == about(std::cos(0.03 / 0.15)).epsilon(1e-4));
  CHECK(r.dot(body.mass * r) == about(2700 * 2e-3 * shell.area_m2()).epsilon(1e-12));
  const Eigen::VectorXd force = body.stiffness * r;
  CHECK(force.cwiseAbs().maxCoeff() <= 1e-12 * body.stiffness.diagonal().maxCoeff());
  CHECK(shell_structure(Shell(shells::panel(shape, shells::isotropic(70e9, 0.3, 2e-3, 2700), "FFFC", 3, 2)),
                        {{0.1, 0.05}})
            .translation.size() == 0);
}

TEST_CASE("shells that cannot be are refused") {
  ShellPanel bad = rough_panel();
  bad.lines_x[2] = bad.lines_x[1];
  CHECK_THROWS_WITH_AS(Shell{bad}, "mesh line 3 along x at 0.1 m isn't beyond the one before", std::invalid_argument);
  bad = rough_panel();
  bad.lines_y.back() = 0.25;
  CHECK_THROWS_WITH_AS(Shell{bad}, "the mesh lines along y go from 0 m to 0.25 m and not from 0 to 0.2 m",
                       std::invalid_argument);
  bad = rough_panel();
  bad.laminate.mass_kg_per_m2 = 0;
  CHECK_THROWS_WITH_AS(Shell{bad}, "the laminate's mass 0 kg/m² is not positive", std::invalid_argument);
  bad = rough_panel();
  bad.laminate.thickness_m = 0.2;
  CHECK_THROWS_WITH_AS(Shell{bad},
                       "the laminate is 0.2 m thick, the panel only 0.2 m wide; a thin shell is wider than thick",
                       std::invalid_argument);
  bad = rough_panel();
  bad.shape.radius_m = -0.2;
  bad.laminate.thickness_m = 0.199;
  CHECK_NOTHROW(require_valid(bad));
  bad.shape.radius_m = -0.15;
  CHECK_THROWS_WITH_AS(
      Shell{bad},
      "the laminate is 0.199 m thick and the radius of curvature 0.15 m; a thin shell has the larger radius",
      std::invalid_argument);
  const Shell shell(rough_panel("CCCC"));
  CHECK_THROWS_WITH_AS((void)shell.strain(rest(shell), {0.4, 0.1}),
                       "the point (0.4 m, 0.1 m) is outside the panel of 0.3 m x 0.2 m", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)shell_structure(shell, {{0.3, 0.1}}),
                       "the point (0.3 m, 0.1 m) is on a support, which doesn't let it move; strike elsewhere",
                       std::invalid_argument);
}

}  // namespace
}  // namespace impulse
