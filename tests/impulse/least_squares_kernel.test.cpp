#include "impulse/measured/least_squares_kernel.hpp"

#include "lib/contract/errors.hpp"
#include "tests/support/about.hpp"
#include "tests/support/direct_sums.hpp"
#include "tests/support/records.hpp"

#include <Eigen/Dense>

#include <doctest/doctest.h>

#include <algorithm>

using namespace impulse;

namespace {

Eigen::MatrixXd toeplitz(const std::vector<double>& first_column) {
  const auto n = static_cast<Eigen::Index>(first_column.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) matrix(i, j) = first_column[static_cast<std::size_t>(i - j)];
  return matrix;
}

Eigen::Map<const Eigen::VectorXd> vector(const std::vector<double>& x) {
  return {x.data(), static_cast<Eigen::Index>(x.size())};
}

/// The dense problem, by definition.
struct Dense {
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
  double largest_power = 0;

  Dense(const std::vector<InputOutput>& records, double regularisation) {
    const auto n = static_cast<Eigen::Index>(records[0].input.size());
    normal = Eigen::MatrixXd::Zero(n, n);
    right = Eigen::VectorXd::Zero(n);
    std::vector<double> power;
    for (const InputOutput& record : records) {
      const Eigen::MatrixXd t = toeplitz(record.input);
      normal += t.transpose() * t;
      right += t.transpose() * vector(record.output);
      std::vector<double> padded = record.input;
      padded.resize(fast_transform_size(2 * padded.size()));
      const auto spectrum = direct::transform(padded);
      power.resize(spectrum.size());
      for (std::size_t k = 0; k < power.size(); ++k) power[k] += std::norm(spectrum[k]);
    }
    largest_power = *std::ranges::max_element(power);
    normal.diagonal().array() += regularisation * largest_power;
  }
};

std::vector<InputOutput> random_records(std::size_t size, std::size_t support, std::size_t count, double sigma,
                                        unsigned seed) {
  std::mt19937_64 engine(seed);
  const std::vector<double> kernel = direct::random_values(size, seed);
  std::vector<InputOutput> records;
  for (std::size_t b = 0; b < count; ++b) {
    std::vector<double> input = records::noise(support, 1, engine);
    input.resize(size);
    std::vector<double> output = direct::convolution(kernel, input);
    records::add_noise(output, sigma, engine);
    records.push_back({std::move(input), std::move(output)});
  }
  return records;
}

}  // namespace

TEST_CASE("least_squares_kernel: the solution and deviations of the dense problem") {
  for (std::size_t support : {1u, 7u, 60u}) {
    CAPTURE(support);
    const double regularisation = 1e-3;
    const std::vector<InputOutput> records = random_records(60, support, 3, 0.1, 5);
    const EstimatedKernel kernel =
        least_squares_kernel(records, {.regularisation = regularisation, .tolerance = 1e-10});
    const Dense dense(records, regularisation);
    const Eigen::VectorXd x = dense.normal.llt().solve(dense.right);
    CHECK((vector(kernel.values) - x).norm() < 1e-8 * x.norm());

    REQUIRE(kernel.deviations.size() == 3);
    CHECK(kernel.degrees_of_freedom == 2);
    Eigen::MatrixXd scores(60, 3);
    for (Eigen::Index b = 0; b < 3; ++b) {
      const InputOutput& record = records[static_cast<std::size_t>(b)];
      const Eigen::MatrixXd t = toeplitz(record.input);
      scores.col(b) = t.transpose() * (vector(record.output) - t * x);
    }
    const Eigen::VectorXd mean = scores.rowwise().mean();
    for (Eigen::Index b = 0; b < 3; ++b) {
      const Eigen::VectorXd deviation = std::sqrt(1.5) * dense.normal.llt().solve(scores.col(b) - mean);
      // The last samples are hardly determined; a response leaves them out.
      const auto determined = static_cast<Eigen::Index>(60 - support);
      CHECK((vector(kernel.deviations[static_cast<std::size_t>(b)]) - deviation).head(determined).norm() <=
            0.02 * deviation.head(determined).norm());
    }
  }
}

TEST_CASE("least_squares_kernel: its standard uncertainty is that of the bootstrap over records") {
  const double regularisation = 1e-2;
  std::vector<InputOutput> records = random_records(24, 6, 8, 0, 11);
  std::mt19937_64 engine(3);
  for (std::size_t b = 0; b < records.size(); ++b) {  // alike but for their strength, as blows are
    records[b].input = records[0].input;
    for (double& value : records[b].input) value *= 1 + 0.02 * static_cast<double>(b);
    records[b].output = direct::convolution(direct::random_values(24, 11), records[b].input);
    records::add_noise(records[b].output, 0.05, engine);
  }
  const EstimatedKernel kernel = least_squares_kernel(records, {.regularisation = regularisation});
  // λ belongs to the problem, not to the resample.
  const double lambda = regularisation * Dense(records, 0).largest_power;
  std::vector<Eigen::MatrixXd> normal;
  std::vector<Eigen::VectorXd> right;
  for (const InputOutput& record : records) {
    const Eigen::MatrixXd t = toeplitz(record.input);
    normal.emplace_back(t.transpose() * t);
    right.emplace_back(t.transpose() * vector(record.output));
  }
  std::uniform_int_distribution<std::size_t> pick(0, records.size() - 1);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(24), squares = Eigen::VectorXd::Zero(24);
  const int resamples = 4000;
  for (int r = 0; r < resamples; ++r) {
    Eigen::MatrixXd a = lambda * Eigen::MatrixXd::Identity(24, 24);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(24);
    for (std::size_t k = 0; k < records.size(); ++k) {
      const std::size_t chosen = pick(engine);
      a += normal[chosen];
      b += right[chosen];
    }
    const Eigen::VectorXd x = a.llt().solve(b);
    sum += x;
    squares += x.cwiseAbs2();
  }
  const Eigen::VectorXd variance = (squares - sum.cwiseAbs2() / resamples) / (resamples - 1);
  double ratio = 0;
  for (Eigen::Index n = 0; n < 24; ++n) {
    double linearised = 0;
    for (const auto& d : kernel.deviations)
      linearised += d[static_cast<std::size_t>(n)] * d[static_cast<std::size_t>(n)];
    // A resample's variance is 7/8 of the sample's; the ridge moves with the resample's weight.
    ratio += std::sqrt(variance(n) * 8 / 7 / linearised) / 24;
  }
  // The bootstrap itself is known to 1/√8000, less for the mean over the samples.
  CHECK(ratio == about(1).epsilon(0.03));
}

TEST_CASE("least_squares_kernel: a constraint is met, by the kernel best under it") {
  const std::vector<InputOutput> records = random_records(40, 9, 2, 0.1, 7);
  const LinearConstraint constraint{direct::random_values(40, 8), 0.7};
  const EstimatedKernel kernel =
      least_squares_kernel(records, {.regularisation = 1e-3, .constraint = &constraint, .tolerance = 1e-10});
  const Eigen::VectorXd a = vector(constraint.weight);
  CHECK(a.dot(vector(kernel.values)) == about(0.7).epsilon(1e-12));
  for (const auto& deviation : kernel.deviations) CHECK(std::abs(a.dot(vector(deviation))) < 1e-12);
  // The gradient is along the constraint: A x - b = μ a.
  const Dense dense(records, 1e-3);
  const Eigen::VectorXd gradient = dense.normal * vector(kernel.values) - dense.right;
  CHECK((gradient - a * a.dot(gradient) / a.squaredNorm()).norm() < 1e-7 * dense.right.norm());
}

TEST_CASE("least_squares_kernel: no causality is broken and nothing depends on what follows the record") {
  std::vector<InputOutput> records = random_records(50, 5, 1, 0, 9);
  // The same experiment, watched for longer, must not change the kernel where the shorter record fixes it.
  const EstimatedKernel shorter = [&] {
    std::vector<InputOutput> cut = records;
    cut[0].input.resize(40);
    cut[0].output.resize(40);
    return least_squares_kernel(cut, {.regularisation = 1e-9});
  }();
  const EstimatedKernel longer = least_squares_kernel(records, {.regularisation = 1e-9});
  for (std::size_t n = 0; n < 30; ++n) CHECK(std::abs(shorter.values[n] - longer.values[n]) < 1e-4);
}

TEST_CASE("least_squares_kernel: work does not grow with the record") {
  std::size_t fewest = 1000, most = 0;
  for (std::size_t size : {500u, 2000u, 8000u}) {
    std::mt19937_64 engine(1);
    InputOutput record{records::half_sine(size, 1, 40, 1), {}};
    record.output = convolution(record.input, direct::random_values(size, 2), size);
    const EstimatedKernel kernel = least_squares_kernel({&record, 1}, {.regularisation = 1e-4});
    fewest = std::min(fewest, kernel.iterations);
    most = std::max(most, kernel.iterations);
  }
  CAPTURE(most);
  CHECK(most <= 20);
  CHECK(most <= 2 * fewest);
}

TEST_CASE("divided_kernel: exact, past leading zeros, with the deviations of the mean") {
  std::vector<InputOutput> records = random_records(64, 64, 2, 0, 4);
  for (InputOutput& record : records) {
    record.input[0] = 3;  // a well-conditioned beginning
    record.output = direct::convolution(direct::random_values(64, 4), record.input);
    record.input.insert(record.input.begin(), 2, 0.0);
    record.output.insert(record.output.begin(), 2, 0.0);
  }
  const EstimatedKernel kernel = divided_kernel(records);
  CHECK(kernel.values.size() == 64);
  CHECK(kernel.degrees_of_freedom == 1);
  const std::vector<double> expected = direct::random_values(64, 4);
  CHECK(direct::largest_difference(kernel.values, expected) < 1e-9);
  for (const auto& deviation : kernel.deviations)
    CHECK(direct::largest_difference(deviation, std::vector<double>(64)) < 1e-9);
}

TEST_CASE("least_squares_kernel: refusals") {
  const std::vector<InputOutput> none;
  const std::vector<InputOutput> zero{{{0, 0, 0}, {1, 2, 3}}};
  const std::vector<InputOutput> unequal{{{1, 0, 0}, {1, 2, 3}}, {{1, 0}, {1, 2}}};
  const KernelOptions options{.regularisation = 1e-3};
  CHECK_THROWS_WITH_AS((void)least_squares_kernel(none, options), doctest::Contains("no record"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)least_squares_kernel(zero, options), doctest::Contains("zero throughout"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)divided_kernel(zero), doctest::Contains("zero throughout"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)least_squares_kernel(unequal, options), doctest::Contains("cut them to one length"),
                       std::invalid_argument);
  const std::vector<InputOutput> good = random_records(30, 30, 1, 0.1, 1);
  CHECK_THROWS_WITH_AS((void)least_squares_kernel(good, {}), doctest::Contains("not positive"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)least_squares_kernel(good, {.regularisation = 1e-12, .most_iterations = 2}),
                       doctest::Contains("larger --regularisation"), ConvergenceError);
  InputOutput gentle{std::vector<double>(400), std::vector<double>(400, 1.0)};
  for (std::size_t n = 0; n < 60; ++n)
    gentle.input[n] = std::exp(-0.02 * (static_cast<double>(n) - 30) * (static_cast<double>(n) - 30));
  CHECK_THROWS_WITH_AS((void)divided_kernel({&gentle, 1}), doctest::Contains("begins too gently"), ConvergenceError);
}
