#include "fem/shell/shell_supports.hpp"

#include "tests/support/about.hpp"
#include "tests/support/shells.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace impulse {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

PanelShape cylinder() { return {.length_m = 0.3, .width_m = 0.2, .curvature = Curvature::along_y, .radius_m = 0.25}; }

Shell supported(const std::string& edges, std::size_t count_y = 3) {
  return Shell(shells::panel(cylinder(), shells::isotropic(70e9, 0.3, 1e-3, 2700), edges, 2, count_y));
}

VectorXd some_displacement(const Shell& shell) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  VectorXd z(shell.size());
  for (Eigen::Index i = 0; i < z.size(); ++i) z(i) = uniform(generator);
  return z;
}

/// Displacement along the radius, the arc and the axis, at a point of the cylinder.
Vector3d in_surface_axes(const Shell& shell, const VectorXd& z, const PanelPoint& point) {
  const double angle = (point.y_m - 0.1) / 0.25;
  const Vector3d u = shell.displacement(z, point);
  return {u(2) * std::cos(angle) - u(1) * std::sin(angle), u(1) * std::cos(angle) + u(2) * std::sin(angle), u(0)};
}

TEST_CASE("each support holds its displacements along a curved edge, at nodes exactly, and leaves the others") {
  const PanelPoint node{0.3, 0.2 / 3};
  struct Case {
    const char* edges;
    bool radial, along, across;
  };
  for (const Case& c :
       {Case{"FFFF", false, false, false}, Case{"FCFF", true, true, true}, Case{"FIFF", true, true, true},
        Case{"FSFF", true, false, true}, Case{"FTFF", true, true, false}, Case{"FWFF", true, false, false},
        Case{"FYFF", false, false, true}}) {
    const Shell shell = supported(c.edges);
    const Vector3d u = in_surface_axes(shell, some_displacement(shell), node);
    CHECK((std::abs(u(0)) < 1e-12) == c.radial);
    CHECK((std::abs(u(1)) < 1e-12) == c.along);
    CHECK((std::abs(u(2)) < 1e-12) == c.across);
  }
}

TEST_CASE("between its nodes a turning condition holds to order 4") {
  double before = 0;
  for (const std::size_t count : {2, 4, 8, 16}) {
    const Shell shell = supported("FWFF", count);
    // A smooth field that satisfies the condition: along the arc, growing.
    VectorXd values = VectorXd::Zero(shell.nodal_values(shells::rest(shell)).size());
    for (std::size_t node = 0; node < 3 * (count + 1); ++node) {
      const double s = shell.panel().lines_y[node / 3], angle = (s - 0.1) / 0.25, f = std::exp(5 * s);
      const auto dof = static_cast<Eigen::Index>(12 * node);
      values.segment<4>(dof + 4) << f * std::cos(angle), 0, 5 * f * std::cos(angle) - 4 * f * std::sin(angle), 0;
      values.segment<4>(dof + 8) << f * std::sin(angle), 0, 5 * f * std::sin(angle) + 4 * f * std::cos(angle), 0;
    }
    const VectorXd z = shell.restrained(values);
    CHECK((shell.nodal_values(z) - values).norm() <= 1e-11 * values.norm());
    const double error = std::abs(in_surface_axes(shell, z, {0.3, 0.1 + 0.1 / static_cast<double>(count)})(0));
    if (count > 2) CHECK(std::log2(before / error) == about(4).epsilon(0.1));
    before = error;
  }
}

TEST_CASE("a clamped edge does not turn, at nodes and between, and keeps its membrane shear") {
  const Shell shell = supported("FCFF", 6);
  const VectorXd z = some_displacement(shell);
  for (const double s : {0.1, 0.2 / 3}) {
    const double d = 1e-7;
    const Vector3d inside = in_surface_axes(shell, z, {0.3 - d, s});
    CHECK(std::abs(inside(0)) <= 1e-4 * inside.norm());  // quadratic in the distance, the others linear
    CHECK(std::abs(inside(1)) > 1e-3 * inside.norm());
  }
}

/// A flat panel inclined at the edge x = a, by a wave and by a slope.
Shell inclined(const std::string& edges) {
  PanelShape shape{.length_m = 0.3, .width_m = 0.2};
  shape.imperfection.waves = {{0.02, 1, 1}};
  shape.imperfection.powers = {{-0.03, 1, 0}};
  return Shell(shells::panel(shape, shells::isotropic(70e9, 0.3, 1e-3, 2700), edges, 4, 4));
}

TEST_CASE("displacements are held along the ideal shape's directions, whatever the imperfection") {
  const PanelPoint node{0.3, 0.05};
  for (const char* edges : {"FWFF", "FTFF", "FSFF"}) {
    const Shell shell = inclined(edges);
    CHECK(std::abs(shell.normal(node)(0)) > 0.1);
    const Vector3d u = shell.displacement(some_displacement(shell), node);
    CHECK(std::abs(u(2)) <= 1e-12);
    CHECK((std::abs(u(0)) <= 1e-12) == (edges[1] == 'S'));
    CHECK((std::abs(u(1)) <= 1e-12) == (edges[1] == 'T'));
  }
}

TEST_CASE("a clamped edge does not turn the imperfect surface's normal") {
  const Shell shell = inclined("FCFF");
  const VectorXd z = some_displacement(shell);
  const PanelPoint edge{0.3, 0.05};
  const Vector3d inside = shell.displacement(z, {0.3 - 1e-7, 0.05});
  CHECK(std::abs(shell.normal(edge).dot(inside)) <= 1e-4 * inside.norm());  // quadratic in the distance
  CHECK(std::abs(inside(2)) > 0.01 * inside.norm());                        // the ideal shape's normal turns
}

TEST_CASE("supports take out as many degrees of freedom as they name") {
  // 3 × 4 nodes; an edge of k nodes held by c components loses 2ck, one clamped 8k.
  CHECK(supported("FFFF").size() == 144);
  CHECK(supported("FIFF").size() == 144 - 24);
  CHECK(supported("FCFF").size() == 144 - 32);
  CHECK(supported("FTFF").size() == 144 - 16);
  CHECK(supported("FWFF").size() == 144 - 8);
  CHECK(supported("IFFF").size() == 144 - 18);
  // All four: inner edge nodes keep 6, corners lose u, u_x and u_y.
  CHECK(supported("IIII").size() == 144 - 6 * 6 - 4 * 9);
}

TEST_CASE("letters of supports") {
  const auto edges = parse_edges("CFIY");
  CHECK(edges[0] == EdgeSupport::clamped);
  CHECK(edges[1] == EdgeSupport::free);
  CHECK(edges[2] == EdgeSupport::immovable);
  CHECK(edges[3] == EdgeSupport::symmetric);
  CHECK(parse_edges("HSTW")[0] == EdgeSupport::immovable);
  CHECK_THROWS_WITH_AS((void)parse_edges("CCXC"), "'X' is not a support; use C, F, H, I, S, T, W or Y",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)parse_edges("CCC"), "'CCC' has 3 letters for four edges (y = 0, x = a, y = b, x = 0)",
                       std::invalid_argument);
}

}  // namespace
}  // namespace impulse
