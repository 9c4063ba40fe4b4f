#include "impulse/response/displacement_response.hpp"

#include "impulse/contact/contact_equation.hpp"
#include "impulse/response/wave_response.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace impulse {
namespace {

TEST_CASE("velocities and accelerations of a smooth displacement, order 2, H(0+) as given") {
  const Eigen::MatrixXd start = Eigen::MatrixXd::Constant(1, 1, 1.0);
  std::vector<double> error_h, error_g;
  for (const int n : {20, 40, 80, 160}) {
    const UniformGrid grid = grid_over(2, 2.0 / n);
    std::vector<double> u(grid.size);
    for (std::size_t k = 0; k < u.size(); ++k) u[k] = std::sin(grid.time_s(k));
    const Response response = displacement_response(grid, {u}, start);
    CHECK(response.pair(0, 0).step_displacement_m_per_N == u);
    CHECK(response.pair(0, 0).step_velocity_m_per_Ns[0] == 1);
    const std::size_t middle = u.size() / 2;
    error_h.push_back(std::abs(response.pair(0, 0).step_velocity_m_per_Ns[middle] - std::cos(1.0)));
    error_g.push_back(std::abs(response.pair(0, 0).impulse_response_per_kg[middle] + std::sin(1.0)));
  }
  for (std::size_t i = 0; i + 1 < error_h.size(); ++i) {
    CHECK(std::log2(error_h[i] / error_h[i + 1]) == about(2).epsilon(0.05));
    CHECK(std::log2(error_g[i] / error_g[i + 1]) == about(2).epsilon(0.05));
  }
}

TEST_CASE("the force does not depend on how H and G were found: a rod's response through its displacements") {
  const Bar bar{{parse_segment("0.5m,10mm,steel")}, {Face::a}, FarEnd::free};
  const UniformGrid grid = grid_over(3e-4, 1e-6);
  const Response exact = wave_response(bar, grid);
  const Response again =
      displacement_response(grid, {exact.pair(0, 0).step_displacement_m_per_N},
                            Eigen::MatrixXd::Constant(1, 1, exact.pair(0, 0).step_velocity_m_per_Ns[0]));
  const ImpactHistory a = solve_contact(exact, exact, {1.0}, ContactMethod::product),
                      b = solve_contact(again, again, {1.0}, ContactMethod::product);
  for (std::size_t k = 0; k < grid.size; ++k) CHECK(a.force_N[k] == b.force_N[k]);
}

TEST_CASE("sizes that disagree are refused") {
  const Eigen::MatrixXd start = Eigen::MatrixXd::Zero(1, 1);
  CHECK_THROWS_WITH(displacement_response(grid_over(1, 0.5), {}, start), "0 displacements for 1 x 1 pairs");
  CHECK_THROWS_WITH(displacement_response(grid_over(1, 1), {{0, 1}}, start),
                    "2 samples are too few for velocities; use three or more");
  CHECK_THROWS_WITH(displacement_response(grid_over(1, 0.5), {{0, 1}}, start),
                    "a displacement of 2 samples on a grid of 3");
  CHECK_THROWS_WITH(displacement_response(grid_over(1, 0.5), {{0, NAN, 1}}, start), doctest::Contains("nan"));
}

}  // namespace
}  // namespace impulse
