#include "fem/implicit/step_equilibrium.hpp"

#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {

using Eigen::VectorXd;

namespace {

/// Of Newton's iteration: a matrix that gains more than two digits in four corrections is good enough for the next one.
constexpr double slow_rate = 0.3;

}  // namespace

StepEquilibrium::StepEquilibrium(StepMatrix matrix, const EquilibriumOptions& options, const VectorXd& load)
    : matrix_(std::move(matrix)), options_(options), solve_(matrix_.at_rest), load_(load) {
  require(options.tolerance > 0 && options.most_iterations >= 1,
          "equilibrium within {} in {} iterations cannot be asked for", options.tolerance, options.most_iterations);
  if (load_.size() > 0) response_ = solve_(load_);
}

bool StepEquilibrium::refresh(const VectorXd& at) {
  LinearSolver solver = matrix_.tangent(at);
  if (!solver) return false;
  solve_ = std::move(solver);
  if (load_.size() > 0) response_ = solve_(load_);
  ++factorisations_;
  return true;
}

bool StepEquilibrium::settled(double relative) {
  // It fades, so that one bad step isn't remembered for ever.
  if (last_correction_ > 0) rate_ = std::clamp(std::max(relative / last_correction_, rate_ / 2), 1e-6, 1.0);
  last_correction_ = relative;
  return rate_ * relative <= options_.tolerance;
}

std::optional<StepEquilibrium::Found> StepEquilibrium::iterate(const Step& step, Iteration kind) {
  VectorXd change = step.start;
  double first = 0, before = 0;
  std::size_t grown = 0;
  last_correction_ = 0;
  for (std::size_t iteration = 1; iteration <= options_.most_iterations; ++iteration) {
    const bool slow = iteration == 1 || rate_ > slow_rate;
    if (kind == Iteration::newton && slow && !refresh(step.tangent_at(change))) return std::nullopt;
    VectorXd correction = solve_(step.residual(change));
    ++iterations_;
    // Divergence is told before the load is asked about a displacement that overflows.
    const double unloaded = correction.norm();
    if (!std::isfinite(unloaded) || (iteration > 1 && unloaded > 1e8 * first)) return std::nullopt;
    if (step.follow) step.follow(change, correction);
    change += correction;
    const double length = correction.norm();
    if (iteration == 1) first = length;
    grown = iteration > 1 && length > before ? grown + 1 : 0;
    before = length;
    if (matrix_.geometry == Geometry::linear || settled(length / std::max(change.norm(), 1e-300)))
      return Found{std::move(change), std::move(correction)};
    if (kind == Iteration::modified && grown == 2) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<StepEquilibrium::Found> StepEquilibrium::find(const Step& step) {
  if (auto found = iterate(step, Iteration::modified)) return found;
  if (!matrix_.tangent) return std::nullopt;
  rate_ = 1;
  return iterate(step, Iteration::newton);
}

}  // namespace impulse
