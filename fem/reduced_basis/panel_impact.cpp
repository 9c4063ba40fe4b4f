#include "fem/reduced_basis/panel_impact.hpp"

#include "lib/contract/require.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace impulse {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

void require_updates(const PanelImpactOptions& options, double step_s) {
  double before = 0;
  for (double time : options.update_s) {
    require(time - before >= step_s * (1 - 1e-9),
            "the basis is to be updated at {:.6g} s, less than a step of {:.6g} s after {:.6g} s; update less often",
            time, step_s, before);
    before = time;
  }
  require(options.update_tolerance > 0, "a tolerance of {} for updates is not positive", options.update_tolerance);
  require(options.method == PanelMethod::ritz || (options.update_s.empty() && std::isinf(options.update_tolerance)),
          "only a basis of Ritz vectors is updated");
}

class Stopwatch {
 public:
  /// Since the last lap.
  double lap_s() {
    const Clock::time_point before = last_;
    last_ = Clock::now();
    return std::chrono::duration<double>(last_ - before).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace

PanelImpact::PanelImpact(const Shell& shell, const Structure& body, const ContactLaw& law,
                         const ImplicitImpactSetup& setup, const PanelImpactOptions& options)
    : shell_(shell), body_(body), options_(options), step_s_(setup.step_s) {
  require_updates(options, setup.step_s);
  Stopwatch watch;
  static_factor_ = SparseCholesky::of(body.stiffness);
  require(static_factor_ && answer_of_held(*static_factor_, body.stiffness, body.contacts.col(0)),
          "the panel can move as a rigid body; hold it at its edges");
  set_up_.factorisation_s = watch.lap_s();
  reduce();
  (void)watch.lap_s();
  const VectorXd& contact = body.contacts.col(0);
  ImplicitImpactSetup own = setup;
  VectorXd seen = contact;
  if (basis_) {
    seen = basis_->vectors.transpose() * contact;
    if (options.left_out == LeftOut::static_) {
      const double whole = contact.dot(static_factor_->solve(contact));
      const double kept = seen.dot(basis_->stiffness.ldlt().solve(seen));
      // Below its own rounding there is none; Ritz vectors hold the static answer.
      own.residual_flexibility_m_per_N = whole - kept > 1e-10 * whole ? whole - kept : 0;
    }
  }
  impact_ = std::make_unique<ImplicitImpact>(*equations_, seen, law, own);
  set_up_.factorisation_s += watch.lap_s();
  initial_energy_J_ = impact_->total_energy();
  before_ = impact_->displacement();
}

void PanelImpact::reduce() {
  const bool linear = options_.geometry == Geometry::linear;
  if (options_.method == PanelMethod::full) {
    equations_ = linear ? linear_equations(body_) : shell_equations(shell_, body_);
    return;
  }
  Stopwatch watch;
  const LinearSolver inverse = [this](const VectorXd& b) { return static_factor_->solve(b); };
  basis_ = std::make_unique<ReducedBasis>(
      options_.method == PanelMethod::modes
          ? modal_basis(shell_, body_, options_.vectors, options_.modes)
          : ritz_basis(inverse, body_.stiffness, body_.mass, body_.contacts.col(0), options_.vectors));
  set_up_.vectors_s = watch.lap_s();
  if (linear) {
    equations_ = linear_equations(*basis_);
  } else if (options_.method == PanelMethod::tensor) {
    const auto found = static_cast<std::size_t>(basis_->vectors.cols());  // fewer where the force excites no more
    tensors_ = std::make_unique<TensorModel>(
        tensor_model(shell_, body_, *static_factor_, *basis_, std::min(options_.nonlinear_vectors, found)));
    *basis_ = tensors_->basis;
    set_up_.tensors_s = watch.lap_s();
    equations_ = tensor_equations(*tensors_);
  } else {
    equations_ = projected_equations(shell_, *basis_);
  }
}

void PanelImpact::update() {
  const bool linear = options_.geometry == Geometry::linear;
  const Eigen::SparseMatrix<double> tangent = linear ? body_.stiffness : shell_.tangent(displacement());
  const VectorXd load =
      impact_->in_contact() ? VectorXd(body_.contacts.col(0)) : VectorXd(body_.mass * basis_->vectors.col(0));
  const ReducedBasis current = ritz_basis(tangent, body_.mass, load, options_.update_vectors);
  auto basis = std::make_unique<ReducedBasis>(appended(*basis_, current.vectors, tangent, body_.mass));
  auto equations = linear ? linear_equations(*basis) : projected_equations(shell_, *basis);
  const Eigen::Index size = equations->size();
  VectorXd d = VectorXd::Zero(size), v = VectorXd::Zero(size);
  d.head(unknowns()) = impact_->displacement();
  v.head(unknowns()) = impact_->velocity();
  impact_->change_equations(*equations, basis->vectors.transpose() * body_.contacts.col(0), d, v);
  basis_ = std::move(basis);
  equations_ = std::move(equations);
  ++updates_;
  steps_since_update_ = 0;
}

void PanelImpact::advance() {
  if (next_time_ < options_.update_s.size() && impact_->time_s() >= options_.update_s[next_time_] - step_s_ / 2) {
    ++next_time_;
    update();
  }
  before_ = impact_->displacement();
  impact_->advance();
  ++steps_since_update_;
  const bool room = unknowns() + static_cast<Eigen::Index>(options_.update_vectors) < body_.mass.rows();
  if (std::isfinite(options_.update_tolerance) && steps_since_update_ >= 10 && room &&
      unbalanced_force() > options_.update_tolerance)
    update();
}

VectorXd PanelImpact::expand(const VectorXd& coordinates) const {
  if (tensors_) return expanded(*tensors_, coordinates);
  return basis_ ? VectorXd(basis_->vectors.leftCols(coordinates.size()) * coordinates) : coordinates;
}

VectorXd PanelImpact::displacement() const { return expand(impact_->displacement()); }

VectorXd PanelImpact::whole_force(const VectorXd& q) const {
  return options_.geometry == Geometry::linear ? VectorXd(body_.stiffness * q) : shell_.internal(q).force;
}

PanelStep PanelImpact::last_step() const {
  return {before_, impact_->displacement(), impact_->last_change_of_velocity(), impact_->mean_force_N()};
}

double PanelImpact::unbalanced_force(const PanelStep& step) const {
  const VectorXd& dv = step.change_of_velocity;
  const VectorXd acceleration = (basis_ ? VectorXd(basis_->vectors.leftCols(dv.size()) * dv) : dv) / step_s_;
  const VectorXd unbalanced = step.mean_force_N * body_.contacts.col(0) -
                              (whole_force(expand(step.before)) + whole_force(expand(step.after))) / 2 -
                              body_.mass * acceleration;
  return std::sqrt(unbalanced.dot(static_factor_->solve(unbalanced)) / (2 * initial_energy_J_));
}

double PanelImpact::energy_drift() const { return impact_->total_energy() / initial_energy_J_ - 1; }

}  // namespace impulse
