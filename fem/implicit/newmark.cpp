#include "fem/implicit/newmark.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"

#include <cmath>
#include <optional>

namespace impulse {

using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

struct Newmark::Work {
  double step;
  Sparse mass;
  VectorXd dashpots;             // empty if there are none
  Sparse stiffness;              // of a linear body
  InternalForce internal_force;  // of a nonlinear one
  EquilibriumOptions options;
  StepEquilibrium equilibrium;
  std::optional<SparseCholesky> mass_factor;

  [[nodiscard]] VectorXd internal(const VectorXd& d) const {
    if (!internal_force) return stiffness * d;
    VectorXd force = VectorXd::Zero(d.size());
    internal_force(d, force);
    return force;
  }
  [[nodiscard]] VectorXd damping(const VectorXd& v) const {
    return dashpots.size() > 0 ? VectorXd(dashpots.cwiseProduct(v)) : VectorXd::Zero(v.size());
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

SparseCholesky factorised(const Sparse& matrix, const char* name) {
  auto factor = SparseCholesky::of(matrix);
  require(factor.has_value(), "{} is not positive definite", name);
  return std::move(*factor);
}

LinearSolver step_solver(const Structure& body, double step_s) {
  Sparse matrix = body.stiffness + (4 / (step_s * step_s)) * body.mass;
  if (body.dashpots.size() > 0) matrix.diagonal() += 2 / step_s * body.dashpots;
  const auto factor = std::make_shared<SparseCholesky>(factorised(matrix, "the matrix of a step, K + 2C/dt + 4M/dt²,"));
  return [factor](const VectorXd& b) { return factor->solve(b); };
}

}  // namespace

Newmark::Newmark(const Structure& body, double step_s) : Newmark(body, nullptr, step_s) {}

Newmark::Newmark(const Structure& body, InternalForce internal_force, double step_s,
                 const EquilibriumOptions& options) {
  require_body(body, step_s);
  const Geometry geometry = internal_force ? Geometry::nonlinear : Geometry::linear;
  StepEquilibrium equilibrium({geometry, step_solver(body, step_s), nullptr}, options);
  work_ = std::make_unique<Work>(Work{step_s, body.mass, body.dashpots, internal_force ? Sparse() : body.stiffness,
                                      std::move(internal_force), options, std::move(equilibrium), std::nullopt});
}

Newmark::Newmark(Newmark&&) noexcept = default;
Newmark& Newmark::operator=(Newmark&&) noexcept = default;
Newmark::~Newmark() = default;

double Newmark::step_s() const { return work_->step; }

void Newmark::set_load(MotionState& state, const VectorXd& load) {
  Work& w = *work_;
  if (!w.mass_factor) w.mass_factor = factorised(w.mass, "the mass matrix");
  state.acceleration =
      w.mass_factor->solve(VectorXd(load - w.internal(state.displacement) - w.damping(state.velocity)));
}

std::size_t Newmark::advance(MotionState& state, const VectorXd& end_load) {
  Work& w = *work_;
  const double rate = 2 / w.step;
  const std::size_t before = w.equilibrium.iteration_count();
  const auto found = w.equilibrium.find(
      {.start = VectorXd::Zero(end_load.size()),
       .residual = [&](const VectorXd& change) -> VectorXd {
         // The velocity and acceleration that the change of displacement so far means.
         const VectorXd velocity = rate * change - state.velocity;
         const VectorXd acceleration = rate * (velocity - state.velocity) - state.acceleration;
         return end_load - w.mass * acceleration - w.damping(velocity) - w.internal(state.displacement + change);
       },
       .follow = nullptr,
       .tangent_at = nullptr});
  if (!found)
    throw ConvergenceError(fmt::format("a step of {:.4g} s finds no equilibrium in {} iterations; use a shorter step",
                                       w.step, w.options.most_iterations),
                           w.options.tolerance, w.equilibrium.last_correction(), w.options.most_iterations);
  const VectorXd change_of_velocity = rate * found->change - 2 * state.velocity;
  state.displacement += found->change;
  state.velocity += change_of_velocity;
  state.acceleration = rate * change_of_velocity - state.acceleration;
  return w.equilibrium.iteration_count() - before;
}

}  // namespace impulse
