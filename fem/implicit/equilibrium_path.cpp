#include "fem/implicit/equilibrium_path.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace impulse {

using Eigen::VectorXd;
using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

/// g(d, λ) = 0 beside the equilibrium, with its derivatives.
struct EquilibriumPath::Condition {
  std::function<double(const PathPoint&)> value;
  std::function<VectorXd(const PathPoint&)> by_displacement;
  double by_load = 0;
};

struct EquilibriumPath::Work {
  ElasticBody body;
  VectorXd load;
  NewtonOptions options;
  Factor factor;
  PathPoint point;
  VectorXd last_step;   // of an arc; empty before the first
  double arc = 0;       // length that the next arc tries
  double achieved = 0;  // by the last failure

  [[nodiscard]] double length(const VectorXd& d) const { return std::sqrt(d.dot(body.metric * d)); }

  bool factorise(const VectorXd& d) {
    factor.factorize(body.tangent(d));
    return factor.info() == Eigen::Success;
  }
};

EquilibriumPath::EquilibriumPath(const ElasticBody& body, const VectorXd& load, const NewtonOptions& options)
    : work_(std::make_unique<Work>()) {
  const Eigen::Index n = load.size();
  require(n > 0 && body.metric.rows() == n && body.metric.cols() == n, "a load of size {} and a metric {} x {}", n,
          body.metric.rows(), body.metric.cols());
  require(load.allFinite() && load.squaredNorm() > 0, "the load is zero or not finite");
  require(options.tolerance > 0 && options.most_iterations >= 1,
          "equilibrium within {} in {} iterations cannot be asked for", options.tolerance, options.most_iterations);
  work_->body = body;
  work_->load = load;
  work_->options = options;
  work_->point.displacement = VectorXd::Zero(n);
  work_->factor.analyzePattern(body.tangent(work_->point.displacement));
}

EquilibriumPath::~EquilibriumPath() = default;

const PathPoint& EquilibriumPath::point() const { return work_->point; }

bool EquilibriumPath::solve(PathPoint& trial, const Condition& condition) {
  Work& w = *work_;
  for (trial.iterations = 1; trial.iterations <= w.options.most_iterations; ++trial.iterations) {
    if (!w.factorise(trial.displacement)) return false;
    const VectorXd by_load = w.factor.solve(w.load);
    const VectorXd by_residual = w.factor.solve(trial.load_factor * w.load - w.body.internal_force(trial.displacement));
    const VectorXd slope = condition.by_displacement(trial);
    const double change = -(condition.value(trial) + slope.dot(by_residual)) / (slope.dot(by_load) + condition.by_load);
    const VectorXd correction = by_residual + change * by_load;
    trial.displacement += correction;
    trial.load_factor += change;
    w.achieved = w.length(correction) / std::max(w.length(trial.displacement), 1e-300);
    if (!std::isfinite(w.achieved)) return false;
    if (w.achieved <= w.options.tolerance) return true;
  }
  return false;
}

const PathPoint& EquilibriumPath::load_to(double load_factor) {
  Work& w = *work_;
  const VectorXd none = VectorXd::Zero(w.load.size());
  PathPoint trial = w.point;
  if (!solve(trial, {[&](const PathPoint& at) { return at.load_factor - load_factor; },
                     [&](const PathPoint&) { return none; }, 1}))
    throw ConvergenceError(
        fmt::format("no equilibrium is found at {:g} times the load, coming from {:g} times; take smaller steps, or "
                    "control the displacement where the load has a limit",
                    load_factor, w.point.load_factor),
        w.options.tolerance, w.achieved, w.options.most_iterations);
  return w.point = std::move(trial);
}

const PathPoint& EquilibriumPath::displace_to(const VectorXd& functional, double value) {
  Work& w = *work_;
  PathPoint trial = w.point;
  if (!solve(trial, {[&](const PathPoint& at) { return functional.dot(at.displacement) - value; },
                     [&](const PathPoint&) { return functional; }, 0}))
    throw ConvergenceError(
        fmt::format("no equilibrium is found at a displacement of {:g} m, coming from {:g} m; take smaller steps, or "
                    "follow the arc where the displacement has a limit",
                    value, functional.dot(w.point.displacement)),
        w.options.tolerance, w.achieved, w.options.most_iterations);
  return w.point = std::move(trial);
}

const PathPoint& EquilibriumPath::follow_arc(double longest) {
  Work& w = *work_;
  require(std::isfinite(longest) && longest > 0, "an arc of length {} m leads nowhere", longest);
  const VectorXd start = w.point.displacement;
  w.arc = w.arc > 0 ? std::min(w.arc, longest) : longest;
  VectorXd tangent;
  if (w.factorise(start)) tangent = w.factor.solve(w.load);
  require(tangent.size() > 0 && tangent.allFinite(), "the tangent stiffness is singular at {:g} times the load",
          w.point.load_factor);
  const double along = w.last_step.size() == 0 ? 1 : tangent.dot(w.body.metric * w.last_step);
  const double unit = (along < 0 ? -1 : 1) / w.length(tangent);
  for (int halving = 0; halving <= 10; ++halving, w.arc /= 2) {
    const double s = w.arc;
    PathPoint trial{w.point.load_factor + unit * s, start + unit * s * tangent, 0};
    const auto step = [&](const PathPoint& at) -> VectorXd { return at.displacement - start; };
    const auto metric_step = [&](const PathPoint& at) -> VectorXd { return w.body.metric * step(at); };
    if (!solve(trial, {[&](const PathPoint& at) { return step(at).dot(metric_step(at)) - s * s; },
                       [&](const PathPoint& at) -> VectorXd { return 2 * metric_step(at); }, 0}))
      continue;
    w.last_step = step(trial);
    // Five iterations are what a step that isn't wasted takes.
    w.arc *= std::min(1.5, std::sqrt(5.0 / static_cast<double>(trial.iterations)));
    return w.point = std::move(trial);
  }
  throw ConvergenceError(fmt::format("the path cannot be followed beyond {:g} times the load, not even in steps of "
                                     "{:.3g} m; start with shorter steps",
                                     w.point.load_factor, w.arc),
                         w.options.tolerance, w.achieved, w.options.most_iterations);
}

}  // namespace impulse
