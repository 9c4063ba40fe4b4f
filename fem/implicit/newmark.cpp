#include "fem/implicit/newmark.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"

#include <cmath>
#include <optional>

namespace impulse {

using Sparse = Eigen::SparseMatrix<double>;
using Factor = Eigen::SimplicialLLT<Sparse>;

struct Newmark::Work {
  double step;
  Sparse mass;
  Eigen::VectorXd dashpots;      // empty if there are none
  Sparse stiffness;              // of a linear body
  InternalForce internal_force;  // of a nonlinear one
  EquilibriumOptions options;
  Factor effective;
  std::optional<Factor> mass_factor;
  Eigen::VectorXd residual, correction, change, internal;

  /// f(d) into `internal`.
  void evaluate(const Eigen::VectorXd& d) {
    if (internal_force)
      internal_force(d, internal);
    else
      internal.noalias() = stiffness * d;
  }
};

namespace {

void require_body(const Structure& body, double step_s) {
  const Eigen::Index n = body.stiffness.rows();
  require(n > 0 && body.stiffness.cols() == n && body.mass.rows() == n && body.mass.cols() == n,
          "stiffness {} x {} and mass {} x {} are not square of the same size", body.stiffness.rows(),
          body.stiffness.cols(), body.mass.rows(), body.mass.cols());
  require(body.dashpots.size() == 0 || body.dashpots.size() == n, "{} dashpots for {} degrees of freedom",
          body.dashpots.size(), n);
  require(std::isfinite(step_s) && step_s > 0, "step {} s is not positive", step_s);
}

void factorise(Factor& factor, const Sparse& matrix, const char* name) {
  factor.compute(matrix);
  require(factor.info() == Eigen::Success, "{} is not positive definite", name);
}

}  // namespace

Newmark::Newmark(const Structure& body, double step_s) : Newmark(body, nullptr, step_s) {}

Newmark::Newmark(const Structure& body, InternalForce internal_force, double step_s, const EquilibriumOptions& options)
    : work_(std::make_unique<Work>()) {
  require_body(body, step_s);
  require(options.tolerance > 0 && options.most_iterations >= 1,
          "equilibrium within {} in {} iterations cannot be asked for", options.tolerance, options.most_iterations);
  Work& w = *work_;
  w.step = step_s;
  w.mass = body.mass;
  w.dashpots = body.dashpots;
  if (!internal_force) w.stiffness = body.stiffness;
  w.internal_force = std::move(internal_force);
  w.options = options;
  Sparse effective = body.stiffness + (4 / (step_s * step_s)) * body.mass;
  if (w.dashpots.size() > 0) effective.diagonal() += 2 / step_s * w.dashpots;
  factorise(w.effective, effective, "the matrix of a step, K + 2C/dt + 4M/dt²,");
  const Eigen::Index n = body.stiffness.rows();
  for (Eigen::VectorXd* vector : {&w.residual, &w.correction, &w.change, &w.internal}) vector->setZero(n);
}

Newmark::Newmark(Newmark&&) noexcept = default;
Newmark& Newmark::operator=(Newmark&&) noexcept = default;
Newmark::~Newmark() = default;

double Newmark::step_s() const { return work_->step; }

void Newmark::set_load(MotionState& state, const Eigen::VectorXd& load) {
  Work& w = *work_;
  if (!w.mass_factor) factorise(w.mass_factor.emplace(), w.mass, "the mass matrix");
  w.evaluate(state.displacement);
  w.residual = load - w.internal;
  if (w.dashpots.size() > 0) w.residual -= w.dashpots.cwiseProduct(state.velocity);
  state.acceleration = w.mass_factor->solve(w.residual);
}

std::size_t Newmark::advance(MotionState& state, const Eigen::VectorXd& end_load) {
  Work& w = *work_;
  const double rate = 2 / w.step;
  w.change.setZero();
  for (std::size_t iteration = 1; iteration <= w.options.most_iterations; ++iteration) {
    // The velocity and acceleration that the change of displacement so far means.
    w.residual = (rate * rate) * w.change - (2 * rate) * state.velocity - state.acceleration;
    w.residual = end_load - w.mass * w.residual;
    if (w.dashpots.size() > 0) w.residual -= w.dashpots.cwiseProduct(rate * w.change - state.velocity);
    w.correction = state.displacement + w.change;
    w.evaluate(w.correction);
    w.residual -= w.internal;
    w.correction = w.effective.solve(w.residual);
    w.change += w.correction;
    const double moved = w.change.norm();
    if (!std::isfinite(moved)) break;
    if (w.internal_force && w.correction.norm() > w.options.tolerance * moved) continue;
    state.displacement += w.change;
    w.residual = rate * w.change - 2 * state.velocity;  // the change of velocity
    state.velocity += w.residual;
    state.acceleration = rate * w.residual - state.acceleration;
    return iteration;
  }
  throw ConvergenceError(fmt::format("a step of {:.4g} s finds no equilibrium in {} iterations; use a shorter step",
                                     w.step, w.options.most_iterations),
                         w.options.tolerance, w.correction.norm() / w.change.norm(), w.options.most_iterations);
}

}  // namespace impulse
