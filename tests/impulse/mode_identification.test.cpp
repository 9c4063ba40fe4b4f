#include "impulse/measured/mode_identification.hpp"

#include "impulse/measured/band_filter.hpp"
#include "impulse/measured/exponential_subspace.hpp"
#include "impulse/response/modal_response.hpp"
#include "tests/support/about.hpp"
#include "tests/support/records.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <complex>
#include <random>

using namespace impulse;
using std::numbers::pi;

namespace {

struct Truth {
  std::vector<double> frequency_Hz;
  std::vector<double> damping;
  std::vector<double> participation;
};

ModalModel model_of(const Truth& truth) {
  const auto count = static_cast<Eigen::Index>(truth.frequency_Hz.size());
  ModalModel model{Eigen::VectorXd(count), Eigen::VectorXd(count), Eigen::MatrixXd(count, 1),
                   Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Zero(1, 1)};
  for (Eigen::Index m = 0; m < count; ++m) {
    const auto at = static_cast<std::size_t>(m);
    model.angular_frequency(m) = 2 * pi * truth.frequency_Hz[at];
    model.damping_ratio(m) = truth.damping[at];
    model.participation(m, 0) = truth.participation[at];
  }
  return model;
}

const Truth beam{{180, 496, 973, 1608, 2402}, {.01, .008, .006, .006, .005}, {1.0, 0.9, 1.1, 0.8, 1.0}};

/// A response whose G carries white noise of a fraction of its root mean square; U is its double sum.
Response noisy_response(const Truth& truth, double duration_s, double step_s, double noise, unsigned seed) {
  Response response = modal_response(model_of(truth), grid_over(duration_s, step_s));
  std::vector<double>& u = response.pairs[0].step_displacement_m_per_N;
  std::vector<double> second(u.size());
  for (std::size_t k = 1; k + 1 < u.size(); ++k) second[k] = u[k + 1] - 2 * u[k] + u[k - 1];
  std::mt19937_64 engine(seed);
  records::add_noise(second, noise * records::rms(second), engine);
  for (std::size_t k = 1; k + 1 < u.size(); ++k) u[k + 1] = 2 * u[k] - u[k - 1] + second[k];
  return response;
}

}  // namespace

TEST_CASE("mode_identification: modes at 40 dB: frequencies 0.01 %, damping 2 %, participations 1 %") {
  for (unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    CAPTURE(seed);
    const Identification found =
        identified_modes(noisy_response(beam, 0.5, 2e-5, 0.01, seed), {.highest_frequency_Hz = 3000});
    REQUIRE(found.modes.mode_count() == 5);
    for (Eigen::Index m = 0; m < 5; ++m) {
      const auto at = static_cast<std::size_t>(m);
      CHECK(std::abs(found.modes.angular_frequency(m) / (2 * pi) / beam.frequency_Hz[at] - 1) < 1e-4);
      CHECK(std::abs(found.modes.damping_ratio(m) / beam.damping[at] - 1) < 0.02);
      CHECK(std::abs(found.modes.participation(m, 0) / beam.participation[at] - 1) < 0.01);
    }
  }
}

TEST_CASE(
    "mode_identification: without noise the modes are exact, also under a filter and with others above the band") {
  Truth all = beam;
  all.frequency_Hz.insert(all.frequency_Hz.end(), {7000, 11000});
  all.damping.insert(all.damping.end(), {.01, .01});
  all.participation.insert(all.participation.end(), {1, 1});
  const Identification found = identified_modes(noisy_response(all, 0.4, 2e-5, 0, 1), {.highest_frequency_Hz = 2600});
  REQUIRE(found.modes.mode_count() == 5);
  for (Eigen::Index m = 0; m < 5; ++m) {
    const auto at = static_cast<std::size_t>(m);
    // What the filter lets through of the modes above: 74 dB down, and gone soon.
    CHECK(std::abs(found.modes.angular_frequency(m) / (2 * pi) / beam.frequency_Hz[at] - 1) < 1e-6);
    CHECK(std::abs(found.modes.damping_ratio(m) / beam.damping[at] - 1) < 1e-3);
    CHECK(std::abs(found.modes.participation(m, 0) / beam.participation[at] - 1) < 1e-3);
  }
  CHECK(found.relative_residual < 1e-3);
}

TEST_CASE("mode_identification: a closely spaced pair is two modes") {
  // 0.8 % apart, half-power bandwidths of 0.6 %.
  const Truth pair{{1000, 1008, 2100}, {.003, .003, .004}, {1.0, 0.7, 0.5}};
  const Identification found =
      identified_modes(noisy_response(pair, 0.5, 2e-5, 0.01, 7), {.highest_frequency_Hz = 2500});
  REQUIRE(found.modes.mode_count() == 3);
  for (Eigen::Index m = 0; m < 3; ++m) {
    const auto at = static_cast<std::size_t>(m);
    CHECK(std::abs(found.modes.angular_frequency(m) / (2 * pi) / pair.frequency_Hz[at] - 1) < 1e-4);
    CHECK(std::abs(found.modes.damping_ratio(m) / pair.damping[at] - 1) < 0.02);
    CHECK(std::abs(found.modes.participation(m, 0) / pair.participation[at] - 1) < 0.01);
  }
}

TEST_CASE("mode_identification: a free body's mass, found or known") {
  Truth free = beam;
  free.frequency_Hz.insert(free.frequency_Hz.begin(), 0);
  free.damping.insert(free.damping.begin(), 0);
  free.participation.insert(free.participation.begin(), 0.8);
  const Response response = noisy_response(free, 0.5, 2e-5, 0.01, 3);
  const Identification found =
      identified_modes(response, {.highest_frequency_Hz = 3000, .rigid_body = RigidBody::free});
  REQUIRE(found.modes.mode_count() == 6);
  CHECK(found.modes.angular_frequency(0) == 0);
  CHECK(found.modes.participation(0, 0) == about(0.8).epsilon(0.01));
  const Identification known =
      identified_modes(response, {.highest_frequency_Hz = 3000, .rigid_body = RigidBody::known, .mass_kg = 1 / 0.64});
  CHECK(known.modes.participation(0, 0) == about(0.8).epsilon(1e-12));
  CHECK(known.modes.angular_frequency(3) == about(2 * pi * 973).epsilon(1e-4));
}

TEST_CASE("mode_identification: the residual flexibility is what U is short of") {
  Response response = noisy_response(beam, 0.4, 2e-5, 0, 1);
  for (double& u : response.pairs[0].step_displacement_m_per_N) u += 3e-9;
  const Identification found =
      identified_modes(response, {.highest_frequency_Hz = 3000, .residual = IdentificationOptions::Residual::fitted});
  CHECK(found.modes.residual_flexibility(0, 0) == about(3e-9).epsilon(1e-3));
}

TEST_CASE("mode_identification: the diagram has a stable line for every mode, and --modes limits the fit") {
  const Response response = noisy_response(beam, 0.4, 2e-5, 0.03, 3);
  const Identification found = identified_modes(response, {.highest_frequency_Hz = 3000, .largest_order = 20});
  for (double frequency : beam.frequency_Hz) {
    const auto stable = std::ranges::count_if(found.diagram, [&](const StabilisationPoint& point) {
      return point.stable && std::abs(point.frequency_Hz / frequency - 1) < 2e-3;
    });
    CHECK(stable >= 12);
  }
  CHECK(found.diagram.back().order == 20);
  CHECK(identified_modes(response, {.highest_frequency_Hz = 3000, .modes = 2}).modes.mode_count() == 2);
}

TEST_CASE("mode_identification: the filter leaves exponentials exponentials, with the gain that it states") {
  for (double highest : {0.5, 0.12, 0.031}) {
    const BandFilter filter(highest);
    const std::complex<double> z = std::exp(std::complex<double>(-0.002, 0.1 * highest));
    std::vector<double> x(4000);
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = std::pow(z, static_cast<double>(k)).real();
    const std::vector<double> y = filter.filtered(x);
    for (std::size_t j = 0; j < y.size(); ++j) {
      const auto at = static_cast<double>(filter.first() + j * filter.decimation());
      CHECK(std::abs(y[j] - (filter.gain(z) * std::pow(z, at)).real()) < 1e-12);
    }
    CHECK(std::abs(filter.gain(std::polar(1.0, 2 * pi * 0.5 * highest)) - filter.gain(1.0)) < 2.1);
    if (filter.decimation() > 1)
      CHECK(std::abs(filter.gain(std::polar(1.0, 2 * pi * 0.51 / static_cast<double>(filter.decimation())))) < 3e-4);
    CHECK(std::abs(filter.gain(1.0) - 1.0) < 1e-12);
  }
  CHECK_THROWS_WITH_AS(BandFilter(0.6), doctest::Contains("not in (0, 0.5]"), std::invalid_argument);
}

TEST_CASE("mode_identification: the subspace finds the poles of exponentials exactly") {
  std::vector<double> series(200);
  const std::complex<double> a = std::polar(0.99, 0.5);
  const std::complex<double> b = std::polar(0.97, 0.7);
  for (std::size_t k = 0; k < 200; ++k)
    series[k] = std::pow(a, static_cast<double>(k)).real() + 0.3 * std::pow(b, static_cast<double>(k)).imag();
  const auto poles = ExponentialSubspace(series).poles(4);
  for (std::complex<double> z : {a, b, std::conj(a), std::conj(b)}) {
    double nearest = 1;
    for (std::complex<double> pole : poles) nearest = std::min(nearest, std::abs(pole - z));
    CHECK(nearest < 1e-6);  // H Hᵀ squares the condition
  }
  CHECK_THROWS_WITH_AS(ExponentialSubspace(std::vector<double>(5)), doctest::Contains("too few"),
                       std::invalid_argument);
}

TEST_CASE("mode_identification: refusals") {
  const Response response = noisy_response(beam, 0.1, 2e-5, 0, 1);
  CHECK_THROWS_WITH_AS((void)identified_modes(response, {}), doctest::Contains("highest frequency"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)identified_modes(response, {.highest_frequency_Hz = 3e4}),
                       doctest::Contains("highest frequency"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)identified_modes(response, {.highest_frequency_Hz = 100, .largest_order = 1}),
                       doctest::Contains("no stability"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)identified_modes(zero_response({1, 100}, 2), {.highest_frequency_Hz = 0.2}),
                       doctest::Contains("has 2"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)identified_modes(response, {.highest_frequency_Hz = 3000, .rigid_body = RigidBody::known}),
                       doctest::Contains("not positive"), std::invalid_argument);
}
