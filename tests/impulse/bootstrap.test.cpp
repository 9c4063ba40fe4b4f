#include "impulse/measured/bootstrap.hpp"

#include "impulse/measured/response_estimate.hpp"
#include "tests/support/about.hpp"
#include "tests/support/records.hpp"
#include "tests/support/struck_structures.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace impulse;

namespace {

/// Records of one sample each, whose estimate is their mean.
std::vector<InputOutput> numbers(const std::vector<double>& values) {
  std::vector<InputOutput> records;
  for (double value : values) records.push_back({{1, 0}, {value, -2 * value}});
  return records;
}

std::vector<double> mean(std::span<const InputOutput> records) {
  std::vector<double> sum(2);
  for (const InputOutput& record : records)
    for (std::size_t n = 0; n < 2; ++n) sum[n] += record.output[n] / static_cast<double>(records.size());
  return sum;
}

double covariance(const std::vector<std::vector<double>>& deviations, std::size_t a, std::size_t b) {
  double sum = 0;
  for (const auto& d : deviations) sum += d[a] * d[b];
  return sum;
}

}  // namespace

TEST_CASE("bootstrap: of a mean of five, its variance s²/5 without bias, not the 4/5 of it that resamples have") {
  const std::vector<InputOutput> records = numbers({1, 2, 4, 7, 11});
  const auto deviations = bootstrap_deviations(records, {.resamples = 10000, .seed = 3}, mean);
  // Σ(x - 5)² = 66, so s² = 16.5. 10000 resamples tell a variance to 1.4 %.
  CHECK(covariance(deviations, 0, 0) == about(16.5 / 5).epsilon(0.05));
  CHECK(covariance(deviations, 0, 1) == about(-2 * covariance(deviations, 0, 0)));
  double sum = 0;
  for (const auto& d : deviations) sum += d[0];
  CHECK(std::abs(sum) < 1e-9);
}

TEST_CASE("bootstrap: a seed gives the same deviations on any number of threads, another one others") {
  const std::vector<InputOutput> records = numbers({1, 2, 4, 7, 11});
  const auto with = [&](std::size_t seed, std::size_t threads) {
    return bootstrap_deviations(records, {.resamples = 100, .seed = seed, .threads = threads}, mean);
  };
  CHECK(with(1, 1) == with(1, 2));
  CHECK(with(1, 1) == with(1, 3));
  CHECK(with(1, 1) != with(2, 1));
}

TEST_CASE("bootstrap: for every estimator, standard uncertainties are those without it") {
  structures::HammerTest hammer;
  hammer.size = 300;
  const PairResponse body = modal_response(structures::beam(), {hammer.step_s, hammer.size + 1}).pairs[0];
  std::vector<Blow> blows = structures::blows(body, hammer, 5);
  // As strong as each other: closed form and resamples then are the same to first order in the noise.
  for (Blow& blow : blows) {
    const double largest = *std::ranges::max_element(blow.force_N);
    for (double& value : blow.force_N) value *= 100 / largest;
    for (double& value : blow.response) value *= 100 / largest;
  }
  struct Case {
    ResponseEstimator estimator;
    std::optional<double> window_s;
    double tolerance;
  };
  // H2's quotient is far from linear in the draw; the jackknife beside it errs on the safe side.
  for (const Case& one : {Case{ResponseEstimator::least_squares, {}, 0.08},
                          Case{ResponseEstimator::least_squares, 1e-3, 0.08}, Case{ResponseEstimator::h1, 1e-3, 0.08},
                          Case{ResponseEstimator::h2, 1e-3, 0.4}, Case{ResponseEstimator::hv, 1e-3, 0.1}}) {
    CAPTURE(static_cast<int>(one.estimator));
    EstimateOptions options{.estimator = one.estimator,
                            .regularisation = {Regularisation::Rule::value, 1e-4},
                            .exponential_s = one.window_s};
    const MeasuredResponse closed = estimated_response(blows, hammer.step_s, options).measured;
    options.bootstrap = Bootstrap{.resamples = 400, .seed = 2};
    const MeasuredResponse drawn = estimated_response(blows, hammer.step_s, options).measured;
    CHECK(drawn.deviations.size() == 400);
    CHECK(drawn.degrees_of_freedom == 4);
    CHECK(drawn.response.pairs[0].step_velocity_m_per_Ns == closed.response.pairs[0].step_velocity_m_per_Ns);
    const std::vector<double> a = drawn.standard_uncertainty().step_velocity_m_per_Ns;
    const std::vector<double> b = closed.standard_uncertainty().step_velocity_m_per_Ns;
    double squares_a = 0, squares_b = 0;
    for (std::size_t n = 0; n < a.size(); ++n) {
      squares_a += a[n] * a[n];
      squares_b += b[n] * b[n];
    }
    // 400 resamples tell a standard uncertainty to 4 %, and errors along a record are alike.
    CHECK(std::sqrt(squares_a / squares_b) == about(1).epsilon(one.tolerance));
  }
}

TEST_CASE("bootstrap: refusals") {
  CHECK_THROWS_WITH_AS((void)bootstrap_deviations(numbers({1}), {.resamples = 100}, mean),
                       doctest::Contains("two blows at least"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)bootstrap_deviations(numbers({1, 2}), {.resamples = 39}, mean),
                       doctest::Contains("39 resamples"), std::invalid_argument);
}
