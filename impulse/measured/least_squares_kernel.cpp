#include "impulse/measured/least_squares_kernel.hpp"

#include "impulse/measured/normal_equations.hpp"
#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/transform/power_series.hpp"
#include "lib/transform/real_fft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <numbers>
#include <numeric>

namespace impulse {
namespace {

/// A standard uncertainty is itself known to a third from five records.
constexpr double deviation_tolerance = 0.01;

/// Turns scores into those that move the mean: s_b - s̄, scaled so that Σ d dᵀ is the covariance.
void centre(std::vector<std::vector<double>>& scores) {
  const auto count = static_cast<double>(scores.size());
  const double scale = std::sqrt(count / (count - 1));
  for (std::size_t n = 0; n < scores.front().size(); ++n) {
    double mean = 0;
    for (const auto& score : scores) mean += score[n] / count;
    for (auto& score : scores) score[n] = scale * (score[n] - mean);
  }
}

/// One column of A⁻¹ for every score, shared out over two threads, each with its own transforms.
void solve_deviations(std::size_t most_iterations, NormalEquations& first, std::vector<std::vector<double>>& scores) {
  NormalEquations second = first;
  const auto work = [&](NormalEquations& equations, std::size_t begin) {
    for (std::size_t b = begin; b < scores.size(); b += 2)
      scores[b] = equations.solve(scores[b], deviation_tolerance, most_iterations).x;
  };
  std::future<void> other = std::async(std::launch::async, [&] { work(second, 1); });
  work(first, 0);
  other.get();
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

void impose(const LinearConstraint& constraint, const std::vector<double>& direction, EstimatedKernel& kernel) {
  const double slope = dot(constraint.weight, direction);
  const auto move = [&](std::vector<double>& x, double value) {
    const double step = (value - dot(constraint.weight, x)) / slope;
    for (std::size_t n = 0; n < x.size(); ++n) x[n] += step * direction[n];
  };
  move(kernel.values, constraint.value);
  for (auto& deviation : kernel.deviations) move(deviation, 0);
}

}  // namespace

void require_alike(std::span<const InputOutput> records) {
  require(!records.empty(), "no record to estimate from");
  const std::size_t size = records.front().input.size();
  require(size > 1, "a record of {} samples is too short to estimate from", size);
  for (const InputOutput& record : records)
    require(record.input.size() == size && record.output.size() == size,
            "records of {} and {} samples cannot be averaged; cut them to one length", size, record.output.size());
}

double penalty_at(Penalty penalty, std::size_t k, std::size_t transform_size) {
  if (penalty == Penalty::size) return 1;
  const double sine = std::sin(std::numbers::pi * static_cast<double>(k) / static_cast<double>(transform_size));
  return 4 * sine * sine;
}

EstimatedKernel least_squares_kernel(std::span<const InputOutput> records, const KernelOptions& options) {
  require_alike(records);
  require(options.regularisation > 0, "regularisation {} is not positive; divide records without noise instead",
          options.regularisation);
  NormalEquations equations(records, options.regularisation, options.penalty);
  std::vector<double> right(equations.size());
  for (const InputOutput& record : records) {
    const std::vector<double> score = equations.score(record, {});
    for (std::size_t n = 0; n < right.size(); ++n) right[n] += score[n];
  }
  NormalEquations::Solution solution = equations.solve(right, options.tolerance, options.most_iterations);
  EstimatedKernel kernel{std::move(solution.x), {}, records.size() - 1, solution.iterations};
  if (records.size() > 1 && options.deviations == Deviations::closed_form) {
    for (const InputOutput& record : records) kernel.deviations.push_back(equations.score(record, kernel.values));
    centre(kernel.deviations);
    solve_deviations(options.most_iterations, equations, kernel.deviations);
  }
  if (options.constraint) {
    require(options.constraint->weight.size() == kernel.values.size(), "a constraint on {} of {} values",
            options.constraint->weight.size(), kernel.values.size());
    impose(*options.constraint,
           equations.solve(options.constraint->weight, options.tolerance, options.most_iterations).x, kernel);
  }
  return kernel;
}

EstimatedKernel divided_kernel(std::span<const InputOutput> records) {
  require_alike(records);
  const std::size_t size = records.front().input.size();
  std::vector<double> input(size);
  std::vector<double> output(size);
  for (const InputOutput& record : records)
    for (std::size_t n = 0; n < size; ++n) {
      input[n] += record.input[n];
      output[n] += record.output[n];
    }
  const auto begin = std::ranges::find_if(input, [](double x) { return x != 0; });
  require(begin != input.end(), "the inputs are zero throughout, so they say nothing about the outputs");
  const auto skipped = static_cast<std::size_t>(begin - input.begin());
  const std::span<const double> divisor = std::span<const double>(input).subspan(skipped);
  PowerSeriesDivision division(divisor.size());
  const auto divide = [&](const std::vector<double>& dividend) {
    const double scale = std::abs(*std::ranges::max_element(dividend, {}, [](double x) { return std::abs(x); }));
    auto result = division.divide(std::span<const double>(dividend).subspan(skipped), divisor, 1e-13 * scale);
    if (!(result.residual <= 1e-6 * scale))
      throw ConvergenceError(
          fmt::format("dividing the records loses all but {:.1g} of the output (the input begins too gently); use a "
                      "--regularisation",
                      result.residual / scale),
          1e-6, result.residual / scale, result.refinements);
    return std::move(result.quotient);
  };
  EstimatedKernel kernel{divide(output), {}, records.size() - 1, 0};
  if (records.size() == 1) return kernel;
  for (const InputOutput& record : records) {
    std::vector<double> rest = record.output;
    const std::vector<double> explained = convolution(record.input, kernel.values, size);
    for (std::size_t n = 0; n < size; ++n) rest[n] -= explained[n];
    kernel.deviations.push_back(std::move(rest));
  }
  centre(kernel.deviations);
  for (auto& deviation : kernel.deviations) deviation = divide(deviation);
  return kernel;
}

}  // namespace impulse
