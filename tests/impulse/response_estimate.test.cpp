#include "impulse/measured/response_estimate.hpp"

#include "impulse/response/mass_response.hpp"
#include "impulse/response/modal_response.hpp"
#include "lib/numerics/student_t.hpp"
#include "tests/support/about.hpp"
#include "tests/support/records.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace impulse;
using Rule = Regularisation::Rule;

namespace {

constexpr double step = 1e-5;

ModalModel free_body(double mass_kg) {
  const Eigen::Vector4d frequency(0, 2 * std::numbers::pi * 400, 2 * std::numbers::pi * 1100,
                                  2 * std::numbers::pi * 2900);
  const Eigen::Vector4d damping(0, 0.03, 0.02, 0.02);
  const Eigen::Vector4d shape(1, 1.3, 0.9, 1.1);
  return {frequency, damping, shape / std::sqrt(mass_kg), Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Zero(1, 1)};
}

/// Blows of a half sine on a body, noise a fraction of each channel's root mean square (the force's in its pulse).
std::vector<Blow> blows(const PairResponse& body, double sample_s, std::size_t count, std::size_t pulse, double noise,
                        unsigned seed) {
  const std::size_t size = body.step_displacement_m_per_N.size() - 1;
  std::mt19937_64 engine(seed);
  std::vector<Blow> made;
  for (std::size_t b = 0; b < count; ++b) {
    const double peak = 100 * (1 + 0.1 * static_cast<double>(b));
    Blow blow{"blow", records::half_sine(size, 40 + 3 * b, pulse, peak), {}};
    blow.response = records::velocity(body, sample_s, blow.force_N);
    const double level = noise * records::rms(blow.response);
    records::add_noise(blow.force_N, noise * peak / std::sqrt(2.0), engine);
    records::add_noise(blow.response, level, engine);
    made.push_back(std::move(blow));
  }
  return made;
}

/// ‖x - y‖/‖y‖.
double relative_error(const std::vector<double>& x, const std::vector<double>& y) {
  double error = 0, size = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    error += (x[n] - y[n]) * (x[n] - y[n]);
    size += y[n] * y[n];
  }
  return std::sqrt(error / size);
}

}  // namespace

TEST_CASE("response_estimate: a rigid mass is 1/m at every sampling rate, to 1e-12 without regularisation") {
  for (double sample : {1e-7, 2e-6, 1.52588e-5, 1e-3}) {
    CAPTURE(sample);
    const EstimateOptions options{.regularisation = {Rule::none, 0}, .blow = {.force_window_s = 60 * sample}};
    for (std::size_t count : {1u, 3u}) {
      std::vector<Blow> made;
      for (std::size_t b = 0; b < count; ++b) {
        // A pulse that begins with its peak, so that division has no growing part; ∫f by trapezia is then exact.
        Blow blow{"blow", std::vector<double>(1000), {}};
        for (std::size_t n = 40; n < 100; ++n) blow.force_N[n] = 100 * std::pow(0.8, static_cast<double>(n - 40));
        blow.response = cumulative_integral(blow.force_N, sample);
        for (double& value : blow.response) value /= 0.35;
        made.push_back(std::move(blow));
      }
      const ResponseEstimate estimate = estimated_response(made, sample, options);
      for (double g : estimate.measured.response.pairs[0].impulse_response_per_kg)
        CHECK(std::abs(g * 0.35 - 1) < 1e-12);
    }
  }
}

TEST_CASE("response_estimate: an exponential window leaves its mark on the uncertainty as little as on the response") {
  std::vector<Blow> made;
  for (const double gain : {1.0, 1.2}) {  // two blows whose velocities differ by a fifth
    Blow blow{"blow", std::vector<double>(1000), {}};
    for (std::size_t n = 40; n < 100; ++n) blow.force_N[n] = 100 * std::pow(0.8, static_cast<double>(n - 40));
    blow.response = cumulative_integral(blow.force_N, step);
    for (double& value : blow.response) value *= gain;
    made.push_back(std::move(blow));
  }
  for (const std::optional<Bootstrap>& bootstrap : {std::optional<Bootstrap>(), std::optional(Bootstrap{400, 1})}) {
    const EstimateOptions options{.regularisation = {Rule::none, 0},
                                  .blow = {.force_window_s = 60 * step},
                                  .exponential_s = 2e-3,
                                  .bootstrap = bootstrap};
    const MeasuredResponse found = estimated_response(made, step, options).measured;
    const PairResponse uncertainty = found.standard_uncertainty();
    // The mean of 1 and 1.2, half their difference uncertain, from the beginning to e^4 later; 400 resamples: to 4 %.
    for (std::size_t n : {10u, 400u, 800u}) {
      CHECK(found.response.pairs[0].impulse_response_per_kg[n] == about(1.1).epsilon(1e-9));
      CHECK(uncertainty.impulse_response_per_kg[n] == about(0.1).epsilon(bootstrap ? 0.1 : 1e-6));
    }
  }
}

TEST_CASE("response_estimate: a rigid mass is 1/m to 1e-6 through windowed averages at every sampling rate") {
  for (double sample : {1e-7, 2e-6, 1.52588e-5, 1e-3}) {
    const PairResponse mass = mass_response(0.35, {sample, 2001}).pairs[0];
    for (ResponseEstimator estimator : {ResponseEstimator::h1, ResponseEstimator::h2, ResponseEstimator::hv}) {
      const EstimateOptions options{
          .estimator = estimator, .regularisation = {Rule::none, 0}, .exponential_s = 125 * sample};
      const ResponseEstimate estimate = estimated_response(blows(mass, sample, 3, 31, 0, 1), sample, options);
      // e^(t/τ) reaches e^16 = 9e6 and takes the rounding along.
      for (double g : estimate.measured.response.pairs[0].impulse_response_per_kg) CHECK(std::abs(g * 0.35 - 1) < 1e-6);
    }
  }
}

TEST_CASE("response_estimate: noise-free modes, by every estimator") {
  const PairResponse body = modal_response(free_body(1.2), {step, 4001}).pairs[0];
  for (ResponseEstimator estimator : {ResponseEstimator::least_squares, ResponseEstimator::h1, ResponseEstimator::hv}) {
    EstimateOptions options{.estimator = estimator, .regularisation = {Rule::value, 1e-9}};
    options.exponential_s = 2e-3;
    options.duration_s = 0.02;
    const ResponseEstimate estimate = estimated_response(blows(body, step, 2, 12, 0, 1), step, options);
    std::vector<double> h(body.step_velocity_m_per_Ns.begin(), body.step_velocity_m_per_Ns.begin() + 2001);
    // H on samples is a mean of neighbouring steps, of order (ωΔt)²/6 = 5e-3 for the fastest mode.
    CHECK(relative_error(estimate.measured.response.pairs[0].step_velocity_m_per_Ns, h) < 2e-3);
  }
}

TEST_CASE("response_estimate: the mass of a free body holds U, its double integral, where noise would carry it away") {
  const PairResponse body = modal_response(free_body(1.2), {step, 8001}).pairs[0];
  const std::vector<Blow> noisy = blows(body, step, 5, 12, 0.03, 4);
  EstimateOptions options{.duration_s = 0.06};
  const ResponseEstimate without = estimated_response(noisy, step, options);
  options.free_mass_kg = 1.2;
  const ResponseEstimate with = estimated_response(noisy, step, options);
  const std::vector<double> u(body.step_displacement_m_per_N.begin(), body.step_displacement_m_per_N.begin() + 6001);
  const double error_with = relative_error(with.measured.response.pairs[0].step_displacement_m_per_N, u);
  const double error_without = relative_error(without.measured.response.pairs[0].step_displacement_m_per_N, u);
  CHECK(error_with < 4e-3);  // 3 % of noise on v, five blows
  CHECK(error_without > 1.5 * error_with);
  CHECK(with.measured.standard_uncertainty().step_displacement_m_per_N.back() <
        without.measured.standard_uncertainty().step_displacement_m_per_N.back());
}

TEST_CASE("response_estimate: the drift of an integrated accelerometer is taken off") {
  const PairResponse body = modal_response(free_body(1.2), {step, 6001}).pairs[0];
  std::vector<Blow> drifting = blows(body, step, 2, 12, 0, 4);
  for (Blow& blow : drifting)
    for (std::size_t n = 0; n < blow.response.size(); ++n) blow.response[n] += 2e-7 * static_cast<double>(n);
  EstimateOptions options{.regularisation = {Rule::value, 1e-8}, .duration_s = 0.04};
  const std::vector<double> h(body.step_velocity_m_per_Ns.begin(), body.step_velocity_m_per_Ns.begin() + 4001);
  const auto error = [&] {
    return relative_error(estimated_response(drifting, step, options).measured.response.pairs[0].step_velocity_m_per_Ns,
                          h);
  };
  const double before = error();
  options.free_mass_kg = 1.2;
  options.drift = Drift::free;
  CHECK(error() < 0.05 * before);
}

TEST_CASE("response_estimate: faulty blows are left out and named") {
  const PairResponse body = modal_response(free_body(1.2), {step, 3001}).pairs[0];
  std::vector<Blow> some = blows(body, step, 3, 12, 0.01, 4);
  some[1].name = "second.csv";
  for (std::size_t n = 0; n < 12; ++n) some[1].force_N[900 + n] += 40;
  EstimateOptions options;
  const ResponseEstimate estimate = estimated_response(some, step, options);
  REQUIRE(estimate.left_out.size() == 1);
  CHECK(estimate.left_out[0].name == "second.csv");
  CHECK(estimate.left_out[0].fault == BlowFault::second_hit);
  CHECK(estimate.blow_count == 2);
  options.accepted = {BlowFault::second_hit};
  CHECK(estimated_response(some, step, options).blow_count == 3);
  CHECK_THROWS_WITH_AS((void)estimated_response({some[1]}, step, {}), doctest::Contains("second.csv: it hits twice"),
                       std::invalid_argument);
}

TEST_CASE("response_estimate: refusals") {
  const PairResponse body = mass_response(1, {step, 501}).pairs[0];
  const std::vector<Blow> one = blows(body, step, 1, 12, 0, 4);
  CHECK_THROWS_WITH_AS((void)estimated_response(one, step, {.drift = Drift::free}), doctest::Contains("needs its mass"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)estimated_response(one, step, {.estimator = ResponseEstimator::h1, .free_mass_kg = 1}),
                       doctest::Contains("constrains regularised least squares"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)estimated_response(one, step, {.duration_s = 1}), doctest::Contains("the records give"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)estimated_response(one, step, {.exponential_s = 0}), doctest::Contains("time constant"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)estimated_response(one, step, {.blow = {.force_window_s = 1}}),
                       doctest::Contains("leaves nothing"), std::invalid_argument);
}
