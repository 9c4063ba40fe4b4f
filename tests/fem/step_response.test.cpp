#include "fem/implicit/step_response.hpp"

#include "fem/bodies/bar_structure.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace impulse {
namespace {

Structure two_face_rod() {
  const Bar bar{{parse_segment("0.5m,10mm,steel")}, {Face::a, Face::b}, FarEnd::free};
  return bar_structure(bar, bar_mesh_by_count(bar, 30, MassMatrix::consistent));
}

TEST_CASE("the response of an oscillator to a unit step converges with order 2, from 0") {
  Structure body;
  body.stiffness.resize(1, 1);
  body.stiffness.insert(0, 0) = 9;
  body.mass.resize(1, 1);
  body.mass.insert(0, 0) = 1;
  body.contacts = Eigen::MatrixXd::Ones(1, 1);
  body.outputs = Eigen::MatrixXd::Constant(1, 1, -2);
  const UniformGrid grid = grid_over(4, 0.5);
  std::vector<double> error;
  for (const std::size_t substeps : {8u, 16u, 32u, 64u}) {
    const auto u = step_displacements(body, grid, {.substeps = substeps, .observer = {}});
    REQUIRE(u.size() == 2);
    CHECK(u[0][0] == 0);
    double worst = 0;
    for (std::size_t n = 0; n < grid.size; ++n) {
      worst = std::max(worst, std::abs(u[0][n] - (1 - std::cos(3 * grid.time_s(n))) / 9));
      CHECK(u[1][n] == -2 * u[0][n]);
    }
    error.push_back(worst);
  }
  for (std::size_t i = 0; i + 1 < error.size(); ++i)
    CHECK(std::log2(error[i] / error[i + 1]) == about(2).epsilon(0.05));
}

TEST_CASE("a mode too stiff for the step stays on its static displacement instead of ringing") {
  Structure body;
  body.stiffness.resize(1, 1);
  body.stiffness.insert(0, 0) = 1e12;
  body.mass.resize(1, 1);
  body.mass.insert(0, 0) = 1;
  body.contacts = Eigen::MatrixXd::Ones(1, 1);
  body.outputs.resize(1, 0);
  const auto u = step_displacements(body, grid_over(1, 0.1));
  for (std::size_t n = 1; n < u[0].size(); ++n) CHECK(u[0][n] == about(1e-12).epsilon(1e-9));
}

TEST_CASE("contacts are reciprocal and momentum is that of the load; the observer sees the same motion") {
  const Structure body = two_face_rod();
  const UniformGrid grid = grid_over(3e-4, 1e-5);
  std::size_t calls = 0;
  double last = 0;
  const auto u = step_displacements(
      body, grid, {.substeps = 2, .observer = [&](std::size_t load, std::size_t sample, const Eigen::VectorXd& d) {
                     ++calls;
                     if (load == 1 && sample + 1 == grid.size) last = -d(30);
                   }});
  REQUIRE(u.size() == 4);
  CHECK(calls == 2 * grid.size);
  CHECK(last == u[3].back());
  for (std::size_t n = 0; n < grid.size; ++n) {
    CHECK(u[1][n] == about(u[2][n]).epsilon(1e-9));
    CHECK(u[0][n] == about(u[3][n]).epsilon(1e-9));
  }
}

TEST_CASE("a body without contacts and no substeps are refused") {
  Structure body = two_face_rod();
  CHECK_THROWS_WITH(step_displacements(body, grid_over(1e-4, 1e-5), {.substeps = 0, .observer = {}}),
                    "0 substeps; use 1 or more");
  body.contacts.resize(31, 0);
  CHECK_THROWS_WITH(step_displacements(body, grid_over(1e-4, 1e-5)), "a body without a contact has no response");
}

}  // namespace
}  // namespace impulse
