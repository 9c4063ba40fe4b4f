#include "impulse/measured/force_estimate.hpp"

#include "impulse/response/mass_response.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/wave_response.hpp"
#include "tests/support/bars.hpp"
#include "tests/support/records.hpp"

#include <doctest/doctest.h>

using namespace impulse;
using Rule = Regularisation::Rule;

namespace {

constexpr double step = 2e-6;
constexpr std::size_t size = 1500;

/// F ~ sin^1.5, Hertz' pulse, of 200 µs from 100 µs on.
std::vector<double> hertz_pulse() {
  std::vector<double> force(size);
  for (std::size_t k = 0; k <= 100; ++k)
    force[50 + k] = 800 * std::pow(std::sin(std::numbers::pi * static_cast<double>(k) / 100), 1.5);
  return force;
}

double relative_error(const std::vector<double>& x, const std::vector<double>& y) {
  double error = 0, norm = 0;
  for (std::size_t n = 0; n + 20 < y.size(); ++n) {
    error += (x[n] - y[n]) * (x[n] - y[n]);
    norm += y[n] * y[n];
  }
  return std::sqrt(error / norm);
}

Response modes() {
  const Eigen::Vector3d frequency(0, 2 * std::numbers::pi * 700, 2 * std::numbers::pi * 3100);
  return modal_response({frequency, Eigen::Vector3d(0, 0.01, 0.01), Eigen::Vector3d(0.8, 1.0, 0.9),
                         Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Zero(1, 1)},
                        {step, size + 1});
}

}  // namespace

TEST_CASE("force_estimate: the force comes back from the velocity of a mass, of modes and of a rod") {
  const UniformGrid grid{step, size + 1};
  for (const Response& body :
       {mass_response(0.6, grid), modes(), wave_response(bars::steel_rod(0.5, FarEnd::infinite), grid)}) {
    const std::vector<double> force = hertz_pulse();
    UniformSeries velocity{{step, size}, records::velocity(body.pairs[0], step, force)};
    // U, about 1e-6, gives its second differences with 1e-10.
    CHECK(relative_error(estimated_force(velocity, body, {Rule::none, 0}).force_N, force) < 1e-5);
    std::mt19937_64 engine(3);
    records::add_noise(velocity.values, 0.01 * records::rms(velocity.values), engine);
    const ForceEstimate noisy = estimated_force(velocity, body, {});
    CHECK(relative_error(noisy.force_N, force) < 0.1);
    CHECK(noisy.regularisation > 0);
  }
}

TEST_CASE("force_estimate: a mass is Newton's law at every sampling rate") {
  for (double sample : {1e-7, 1e-3}) {
    const Response mass = mass_response(0.6, {sample, size + 1});
    UniformSeries velocity{{sample, size}, cumulative_integral(hertz_pulse(), sample)};
    for (double& value : velocity.values) value /= 0.6;
    CHECK(relative_error(estimated_force(velocity, mass, {Rule::none, 0}).force_N, hertz_pulse()) < 1e-3);
  }
}

TEST_CASE("force_estimate: refusals") {
  const UniformSeries velocity{{step, size}, std::vector<double>(size, 1.0)};
  CHECK_THROWS_WITH_AS((void)estimated_force(velocity, mass_response(1, {step, size}), {}),
                       doctest::Contains("one step more"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)estimated_force(velocity, mass_response(1, {2 * step, 2 * size}), {}),
                       doctest::Contains("record's --step"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)estimated_force(velocity, zero_response({step, 2 * size}, 2), {}),
                       doctest::Contains("2 contacts"), std::invalid_argument);
}
