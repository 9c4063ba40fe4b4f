#include "impulse/measured/measured_response.hpp"

#include "impulse/response/mass_response.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/response_csv.hpp"
#include "impulse/response/wave_response.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"
#include "tests/support/records.hpp"
#include "tests/support/temporary_directory.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace impulse;

namespace {

std::vector<double> kernel_of(const PairResponse& body, double step_s) {
  std::vector<double> impulse(body.step_displacement_m_per_N.size() - 1);
  impulse[1] = 1;
  std::vector<double> kernel = records::velocity(body, step_s, impulse);
  kernel.erase(kernel.begin());
  return kernel;
}

double largest_error(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t n = 0; n < a.size(); ++n) largest = std::max(largest, std::abs(a[n] - b[n]));
  return largest / std::abs(*std::ranges::max_element(b, {}, [](double x) { return std::abs(x); }));
}

}  // namespace

TEST_CASE("measured_response: a rigid mass comes back, at every sampling rate") {
  for (double step : {1e-7, 1.52588e-5, 1e-3, 0.5}) {
    CAPTURE(step);
    const UniformGrid grid{step, 200};
    const PairResponse mass = mass_response(2.5, grid).pairs[0];
    const PairResponse back = response_of_kernel(kernel_of(mass, step), {step, 190});
    for (std::size_t k = 0; k < 190; ++k) {
      // U is a sum of second differences of itself.
      CHECK(std::abs(back.impulse_response_per_kg[k] * 2.5 - 1) < 1e-12 * 200);
      CHECK(std::abs(back.step_velocity_m_per_Ns[k] - mass.step_velocity_m_per_Ns[k]) < 1e-12 * 200 * step / 2.5);
      CHECK(std::abs(back.step_displacement_m_per_N[k] - mass.step_displacement_m_per_N[k]) <=
            1e-12 * mass.step_displacement_m_per_N.back());
    }
  }
}

TEST_CASE("measured_response: U of a rod comes back exactly, H from its right limit on, modes of order 2") {
  const Bar rod = bars::steel_rod(0.5, FarEnd::free);
  const PairResponse exact = wave_response(rod, {1e-6, 400}).pairs[0];
  const PairResponse back = response_of_kernel(kernel_of(exact, 1e-6), {1e-6, 390});
  CHECK(largest_error(back.step_displacement_m_per_N, {exact.step_displacement_m_per_N.begin(),
                                                       exact.step_displacement_m_per_N.begin() + 390}) < 1e-12);
  CHECK(back.step_velocity_m_per_Ns[0] == about(exact.step_velocity_m_per_Ns[0]).epsilon(1e-9));

  const ModalModel modes{Eigen::Vector3d(0, 2e3, 5e3), Eigen::Vector3d(0, 0.01, 0.02), Eigen::Vector3d(1, 1.2, 0.7),
                         Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Zero(1, 1)};
  const auto error = [&](double step) {
    const UniformGrid grid = grid_over(4e-3, step);
    const PairResponse body = modal_response(modes, grid).pairs[0];
    const UniformGrid shorter{step, grid.size - 2};
    const PairResponse found = response_of_kernel(kernel_of(body, step), shorter);
    std::vector<double> h = body.step_velocity_m_per_Ns;
    h.resize(shorter.size);
    return largest_error(found.step_velocity_m_per_Ns, h);
  };
  for (double step : {8e-5, 4e-5, 2e-5, 1e-5}) CHECK(std::abs(std::log2(error(step) / error(step / 2)) - 2) < 0.1);
}

TEST_CASE("measured_response: the rigid-body constraint sees 1/m, not the modes") {
  const double step = 1e-5;
  const UniformGrid grid{step, 2002};
  const LinearConstraint constraint = rigid_body_constraint(0.4, 2000, step);
  const auto mean = [&](const PairResponse& body) {
    const std::vector<double> kernel = kernel_of(body, step);
    double sum = 0;
    for (std::size_t k = 0; k < 2000; ++k) sum += constraint.weight[k] * kernel[k];
    return sum;
  };
  CHECK(constraint.value == 2.5);
  CHECK(mean(mass_response(0.4, grid).pairs[0]) == about(2.5).epsilon(1e-10));
  // T = 20 ms.
  for (double frequency : {170.0, 430.0, 1730.0, 9001.0}) {
    const ModalModel mode{Eigen::VectorXd::Constant(1, 2 * std::numbers::pi * frequency), Eigen::VectorXd::Zero(1),
                          Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Zero(1, 1)};
    CHECK(std::abs(mean(modal_response(mode, grid).pairs[0])) <
          0.5 / std::pow(frequency * 0.02, 3) + 1e-3 * frequency * step);
  }
  CHECK_THROWS_WITH_AS((void)rigid_body_constraint(0, 10, 1), doctest::Contains("not positive"), std::invalid_argument);
}

TEST_CASE("measured_response: columns, with and without deviations") {
  const test::TemporaryDirectory folder;
  const EstimatedKernel kernel{{1, 2, 3, 4}, {{0.3, 0, 0, 0.3}, {-0.4, 0, 0, -0.4}}, 1, 0};
  const MeasuredResponse measured = measured_response(kernel, {0.5, 4});
  const PairResponse std = measured.standard_uncertainty();
  CHECK(std.impulse_response_per_kg[3] == about(0.5 / 0.5));
  CHECK(std.step_displacement_m_per_N[1] == about(0.25));
  const std::string path = folder / "r.csv";
  write_measured_response(path, measured, Members::yes);
  const CsvTable table = read_csv(path);
  CHECK(table.names() ==
        std::vector<std::string>{"time_s", "impulse_response_per_kg", "step_velocity_m_per_Ns",
                                 "step_displacement_m_per_N", "impulse_response_std_per_kg",
                                 "step_velocity_std_m_per_Ns", "step_displacement_std_m_per_N", "degrees_of_freedom",
                                 "impulse_response_deviation_1_per_kg", "step_velocity_deviation_1_m_per_Ns",
                                 "step_displacement_deviation_1_m_per_N", "impulse_response_deviation_2_per_kg",
                                 "step_velocity_deviation_2_m_per_Ns", "step_displacement_deviation_2_m_per_N"});
  CHECK(response_from(table).pairs[0].step_displacement_m_per_N ==
        measured.response.pairs[0].step_displacement_m_per_N);
  write_measured_response(path, measured_response({{1, 2, 3, 4}, {}, 0, 0}, {0.5, 4}), Members::no);
  CHECK(read_csv(path).names().size() == 4);
  CHECK_THROWS_WITH_AS((void)response_of_kernel({1, 2}, {1, 3}), doctest::Contains("does not give"),
                       std::invalid_argument);
}
