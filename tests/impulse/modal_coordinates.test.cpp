#include "impulse/response/modal_coordinates.hpp"

#include "impulse/response/modal_response.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace impulse;

namespace {

ModalModel three_modes() {
  ModalModel model;
  model.angular_frequency = Eigen::Vector3d(0, 3, 40);
  model.damping_ratio = Eigen::Vector3d(0, 0.1, 0);
  model.participation = Eigen::Vector3d(0.5, 1.2, -0.7);
  model.residual_flexibility = Eigen::MatrixXd::Constant(1, 1, 1e-4);
  model.wave_admittance = Eigen::MatrixXd::Zero(1, 1);
  return model;
}

}  // namespace

TEST_CASE("modal_coordinates: a step and a ramp give the step displacement and its integral") {
  const ModalModel model = three_modes();
  const UniformGrid grid{0.05, 400};
  const Response response = modal_response(model, grid);
  UniformSeries step{grid, std::vector<double>(grid.size, 1.0)};
  const Eigen::MatrixXd q = modal_coordinates(model, step);
  const auto& u = response.pair(0, 0).step_displacement_m_per_N;
  for (std::size_t k = 0; k < grid.size; k += 7) {
    const double w = model.participation.col(0).dot(q.col(static_cast<Eigen::Index>(k))) + 1e-4;
    CHECK(w == about(u[k]).epsilon(1e-11));
  }
  // Under F = t the displacement is the integral of U; on a fine grid by Simpson's rule.
  UniformSeries ramp{grid, {}};
  for (std::size_t k = 0; k < grid.size; ++k) ramp.values.push_back(grid.time_s(k));
  const Eigen::MatrixXd r = modal_coordinates(model, ramp);
  const UniformGrid fine{0.05 / 64, 399 * 64 + 1};
  const auto fine_u = modal_response(model, fine).pair(0, 0).step_displacement_m_per_N;
  double integral = 0;
  for (std::size_t k = 0; k + 2 < fine_u.size(); k += 2)
    integral += fine.step_s / 3 * (fine_u[k] + 4 * fine_u[k + 1] + fine_u[k + 2]);
  const double last = model.participation.col(0).dot(r.col(399)) + 1e-4 * ramp.values.back();
  CHECK(last == about(integral).epsilon(1e-8));
}

TEST_CASE("modal_coordinates: refuses a contact that is not there") {
  CHECK_THROWS_WITH((void)modal_coordinates(three_modes(), {{1, 3}, {0, 1, 0}}, 1),
                    "the body has 1 contacts, none numbered 1");
}
