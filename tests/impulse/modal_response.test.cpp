#include "impulse/response/modal_response.hpp"

#include "impulse/exact/bar_modes.hpp"
#include "impulse/response/mass_response.hpp"
#include "impulse/response/wave_response.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

using namespace impulse;

TEST_CASE("modal_response: one damped mode in closed form over many restarts") {
  ModalModel body{Eigen::VectorXd::Constant(1, 3000), Eigen::VectorXd::Constant(1, 0.002),
                  Eigen::MatrixXd::Constant(1, 2, 0.7), Eigen::MatrixXd::Constant(2, 2, 1e-9),
                  Eigen::MatrixXd::Zero(2, 2)};
  body.participation(0, 1) = -0.4;
  const UniformGrid grid{1e-5, 5003};
  const Response response = modal_response(body, grid);
  const double s = 0.002 * 3000;
  const double d = 3000 * std::sqrt(1 - 0.002 * 0.002);
  for (std::size_t k = 0; k < grid.size; ++k) {
    const double t = grid.time_s(k);
    const double c = std::exp(-s * t) * std::cos(d * t);
    const double n = std::exp(-s * t) * std::sin(d * t);
    const double p = -0.28;
    CHECK(std::abs(response.pair(0, 1).impulse_response_per_kg[k] - p * (c - s / d * n)) < 1e-13);
    CHECK(std::abs(response.pair(1, 0).step_velocity_m_per_Ns[k] - p / d * n) < 1e-13 / d);
    CHECK(std::abs(response.pair(0, 1).step_displacement_m_per_N[k] - 1e-9 - p / 9e6 * (1 - c - s / d * n)) <
          1e-13 / 9e6);
  }
}

TEST_CASE("modal_response: a rigid-body mode is a rigid mass") {
  const ModalModel body{Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1),
                        Eigen::MatrixXd::Constant(1, 1, 1 / std::sqrt(2.5)), Eigen::MatrixXd::Zero(1, 1),
                        Eigen::MatrixXd::Zero(1, 1)};
  const UniformGrid grid{1e-4, 100};
  const Response modal = modal_response(body, grid);
  const Response mass = mass_response(2.5, grid);
  for (std::size_t k = 0; k < grid.size; ++k) {
    CHECK(modal.pair(0, 0).impulse_response_per_kg[k] ==
          about(mass.pair(0, 0).impulse_response_per_kg[k]).epsilon(1e-15));
    CHECK(modal.pair(0, 0).step_displacement_m_per_N[k] ==
          about(mass.pair(0, 0).step_displacement_m_per_N[k]).epsilon(1e-15));
  }
  const Response between = mass_response(2.5, {Face::b, Face::a}, grid);
  CHECK(between.pair(0, 1).step_displacement_m_per_N[7] == -mass.pair(0, 0).step_displacement_m_per_N[7]);
  CHECK(between.pair(1, 0).step_velocity_m_per_Ns[7] == -mass.pair(0, 0).step_velocity_m_per_Ns[7]);
  CHECK(between.pair(1, 1).impulse_response_per_kg[7] == mass.pair(0, 0).impulse_response_per_kg[7]);
  CHECK_THROWS_WITH_AS(static_cast<void>(mass_response(1, {Face::a, Face::a}, grid)),
                       doctest::Contains("a mass has two faces"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(static_cast<void>(mass_response(0, grid)), doctest::Contains("mass 0 kg is not positive"),
                       std::invalid_argument);
}

TEST_CASE("modal_response: exact modes converge to the waves as 1/count, first right limit exact") {
  const Bar bar = bars::cone();
  const UniformGrid grid = grid_over(800e-6, 3e-6);
  const Response waves = wave_response(bar, grid);
  std::vector<double> error;
  for (std::size_t count : {100u, 200u, 400u, 800u, 1600u}) {
    const Response modes = modal_response(exact_bar_modes(bar, {.count = count}), grid);
    double squares = 0;
    for (std::size_t k = 0; k < grid.size; ++k)
      squares +=
          std::pow(modes.pair(0, 0).step_displacement_m_per_N[k] - waves.pair(0, 0).step_displacement_m_per_N[k], 2);
    error.push_back(std::sqrt(squares));
    CHECK(modes.pair(0, 0).step_velocity_m_per_Ns[0] ==
          about(waves.pair(0, 0).step_velocity_m_per_Ns[0]).epsilon(1e-13));
  }
  const double slope = std::log2(error.front() / error.back()) / 4;
  CHECK(slope > 0.9);
  CHECK(slope < 1.6);  // between kinks the tail cancels better than it must
}
