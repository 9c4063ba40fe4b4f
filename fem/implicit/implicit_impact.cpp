#include "fem/implicit/implicit_impact.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/numerics/roots.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {

using Eigen::VectorXd;

namespace {

constexpr double theta = 1.4;

/// Gauss points of a step, exact for a cubic.
const double gauss_low = 0.5 - std::sqrt(1.0 / 12), gauss_high = 0.5 + std::sqrt(1.0 / 12);

const ImplicitImpactSetup& valid(const ImplicitImpactSetup& setup, const MotionEquations& equations,
                                 const VectorXd& contact) {
  require(contact.size() == equations.size(), "a contact of {} components for {} unknowns", contact.size(),
          equations.size());
  require(std::isfinite(setup.step_s) && setup.step_s > 0, "step {} s is not positive", setup.step_s);
  require(setup.striker_mass_kg > 0, "the striker's mass {} kg is not positive", setup.striker_mass_kg);
  require(setup.speed_m_per_s > 0, "the striker's speed {} m/s is not positive", setup.speed_m_per_s);
  require(setup.residual_flexibility_m_per_N >= 0 &&
              (setup.rule != StepRule::wilson || setup.residual_flexibility_m_per_N == 0),
          "a residual flexibility of {} m/N cannot be taken; it is not negative, and 0 with Wilson's rule",
          setup.residual_flexibility_m_per_N);
  return setup;
}

}  // namespace

ImplicitImpact::ImplicitImpact(const MotionEquations& equations, const VectorXd& contact, const ContactLaw& law,
                               const ImplicitImpactSetup& setup)
    : equations_(&equations),
      contact_(contact),
      law_(law),
      law_contact_(law, setup.residual_flexibility_m_per_N, 0),
      setup_(valid(setup, equations, contact)),
      equilibrium_(equilibrium()) {
  striker_v_ = setup.speed_m_per_s;
  d_ = v_ = a_ = change_of_velocity_ = VectorXd::Zero(contact.size());
  old_internal_ = equations_->internal_force(d_);
  record();
}

StepEquilibrium ImplicitImpact::equilibrium() const {
  const double dt = setup_.step_s, tau = theta * dt;
  const bool wilson = setup_.rule == StepRule::wilson;
  const double m = wilson ? 6 / (tau * tau) : 2 / (dt * dt), k = wilson ? 1 : 0.5;
  const MotionEquations* equations = equations_;
  return {{.geometry = equations->geometry(),
           .at_rest = equations->solver(m, k),
           .tangent = [=](const VectorXd& q) { return equations->tangent_solver(m, k, q); }},
          setup_.equilibrium,
          contact_};
}

std::size_t ImplicitImpact::iteration_count() const { return earlier_iterations_ + equilibrium_.iteration_count(); }

std::size_t ImplicitImpact::factorisation_count() const {
  return earlier_factorisations_ + equilibrium_.factorisation_count();
}

void ImplicitImpact::change_equations(const MotionEquations& equations, const VectorXd& contact,
                                      const VectorXd& displacement, const VectorXd& velocity) {
  require(contact.size() == equations.size() && displacement.size() == equations.size() &&
              velocity.size() == equations.size(),
          "a contact of {} components and a state of {} for {} unknowns", contact.size(), displacement.size(),
          equations.size());
  equations_ = &equations;
  contact_ = contact;
  d_ = displacement;
  v_ = velocity;
  const VectorXd acceleration = a_;
  a_ = change_of_velocity_ = VectorXd::Zero(d_.size());
  a_.head(std::min(a_.size(), acceleration.size())) = acceleration.head(std::min(a_.size(), acceleration.size()));
  earlier_iterations_ = iteration_count();
  earlier_factorisations_ = factorisation_count();
  equilibrium_ = equilibrium();
  old_internal_ = equations_->internal_force(d_);
}

VectorXd ImplicitImpact::mean_internal_force(const VectorXd& change, VectorXd& end_force) const {
  if (setup_.rule == StepRule::conserving && equations_->geometry() == Geometry::nonlinear)
    return (equations_->internal_force(d_ + gauss_low * change) +
            equations_->internal_force(d_ + gauss_high * change)) /
           2;
  end_force = equations_->internal_force(d_ + change);
  return (old_internal_ + end_force) / 2;
}

StepEquilibrium::Found ImplicitImpact::found(const StepEquilibrium::Step& step) {
  auto found = equilibrium_.find(step);
  if (found) return std::move(*found);
  throw ConvergenceError(
      fmt::format("the step from {:.4g} s on finds no equilibrium in {} iterations; use a step shorter than {:.3g} s",
                  time_s_, setup_.equilibrium.most_iterations, setup_.step_s),
      setup_.equilibrium.tolerance, equilibrium_.last_correction(), setup_.equilibrium.most_iterations);
}

void ImplicitImpact::step_mean_force() {
  const double dt = setup_.step_s;
  const double striker_compliance = dt * dt / (2 * setup_.striker_mass_kg);
  const double flight = striker_d_ + dt * striker_v_ - contact_.dot(d_);
  // Where a linear K_T has the derivative of the mean force: ∫s K(d + sΔ)ds = ½K(d + ⅔Δ).
  const double mean_tangent_at = setup_.rule == StepRule::conserving ? 2.0 / 3 : 1.0;
  LawContact::Answer answer{};
  VectorXd end_force;
  const StepEquilibrium::Found step =
      found({// What the velocity and its last change make of the step, not as the unknown but to begin near it.
             .start = dt * v_ + 0.5 * dt * change_of_velocity_,
             .residual = [&](const VectorXd& change) -> VectorXd {
               return -mean_internal_force(change, end_force) - equations_->mass_times((2 / dt) * (change / dt - v_));
             },
             .follow =
                 [&](const VectorXd& change, VectorXd& correction) {
                   const VectorXd& by_contact = equilibrium_.response();
                   answer = law_contact_.answer(flight - contact_.dot(change) - contact_.dot(correction),
                                                contact_.dot(by_contact) + striker_compliance);
                   correction += answer.mean_force_N * by_contact;
                 },
             .tangent_at = [&](const VectorXd& change) -> VectorXd { return d_ + mean_tangent_at * change; }});
  const VectorXd &change = step.change, &correction = step.last_correction;
  const double residual_change = setup_.residual_flexibility_m_per_N * (answer.force_N - force_);
  law_contact_.accept(answer);
  mean_force_ = answer.mean_force_N;
  const double striker_change = dt * striker_v_ - striker_compliance * mean_force_;
  change_of_velocity_ = 2 * (change / dt - v_);
  if (end_force.size() > 0)
    old_internal_ = equations_->corrected_force(d_ + (change - correction), correction, end_force);
  d_ += change;
  v_ += change_of_velocity_;
  striker_d_ += striker_change;
  striker_v_ -= dt / setup_.striker_mass_kg * mean_force_;
  impulse_ += dt * mean_force_;
  work_1_ -= mean_force_ * striker_change;
  work_2_ += mean_force_ * (contact_.dot(change) + residual_change);
  force_ = law_contact_.force_N();
  indentation_ = law_contact_.indentation_m();
  in_contact_ = law_contact_.in_contact();
}

double ImplicitImpact::wilson_force(double free_approach, double compliance) const {
  if (free_approach <= law_.permanent_indentation(history_)) return 0;
  const double most = law_.force(std::min(free_approach, law_.largest_possible_indentation_m()), history_);
  if (most == 0) return 0;
  return bracketed_root([&](double f) { return f - law_.force(free_approach - compliance * f, history_); }, 0, most,
                        {.absolute = 1e-15 * most});
}

void ImplicitImpact::step_wilson() {
  const double dt = setup_.step_s, tau = theta * dt, mass = setup_.striker_mass_kg;
  // End of step from the increment δ over τ:  a_τ = 6δ/τ² - 6v/τ - 2a,  a_new = a + (a_τ - a)/θ.
  const auto acceleration_at_tau = [&](const VectorXd& delta) -> VectorXd {
    return (6 / (tau * tau)) * delta - (6 / tau) * v_ - 2 * a_;
  };
  const auto displacement_change = [&](const VectorXd& end_acceleration) -> VectorXd {
    return dt * v_ + dt * dt / 6 * (2 * a_ + end_acceleration);
  };
  const double flight = striker_d_ + dt * striker_v_ - dt * dt / 3 * force_ / mass - contact_.dot(d_);
  double new_force = 0;
  const VectorXd delta = found({.start = tau * v_ + tau * tau / 2 * a_,
                                .residual = [&](const VectorXd& change) -> VectorXd {
                                  return (1 - theta) * force_ * contact_ - equations_->internal_force(d_ + change) -
                                         equations_->mass_times(acceleration_at_tau(change));
                                },
                                .follow =
                                    [&](const VectorXd& change, VectorXd& correction) {
                                      const VectorXd& by_contact = equilibrium_.response();
                                      // Of the displacement at the step's end, per unit of the new force.
                                      const double own = contact_.dot(by_contact) * dt * dt / (tau * tau);
                                      const VectorXd end = a_ + (acceleration_at_tau(change + correction) - a_) / theta;
                                      new_force = wilson_force(flight - contact_.dot(displacement_change(end)),
                                                               own + dt * dt / (6 * mass));
                                      correction += theta * new_force * by_contact;
                                    },
                                .tangent_at = [&](const VectorXd& change) -> VectorXd { return d_ + change; }})
                             .change;
  const VectorXd end = a_ + (acceleration_at_tau(delta) - a_) / theta;
  const VectorXd change = displacement_change(end);
  mean_force_ = (force_ + new_force) / 2;
  const double striker_change = dt * striker_v_ - dt * dt / (6 * mass) * (2 * force_ + new_force);
  change_of_velocity_ = dt / 2 * (a_ + end);
  d_ += change;
  v_ += change_of_velocity_;
  a_ = end;
  striker_d_ += striker_change;
  striker_v_ -= dt / mass * mean_force_;
  impulse_ += dt * mean_force_;
  work_1_ -= mean_force_ * striker_change;
  work_2_ += mean_force_ * contact_.dot(change);
  force_ = new_force;
  indentation_ = striker_d_ - contact_.dot(d_);
  in_contact_ = indentation_ > law_.permanent_indentation(history_);
  if (in_contact_ || force_ > 0) history_ = law_.advanced(history_, indentation_);
}

void ImplicitImpact::advance() {
  if (setup_.rule == StepRule::wilson)
    step_wilson();
  else
    step_mean_force();
  time_s_ += setup_.step_s;
  record();
}

void ImplicitImpact::record() {
  const bool mean = setup_.rule != StepRule::wilson;
  trace_.force_N.push_back(force_);
  trace_.running_impulse_Ns.push_back(impulse_);
  trace_.indentation_m.push_back(indentation_);
  trace_.stored_J.push_back(mean ? law_contact_.stored_J() : law_.stored_energy(indentation_, history_));
  trace_.dissipated_J.push_back(mean ? law_contact_.dissipated_J() : history_.dissipated_J);
  trace_.in_contact.push_back(in_contact_);
  trace_.velocity_1_m_per_s.push_back(striker_v_);
  trace_.velocity_2_m_per_s.push_back(contact_.dot(v_));
  trace_.displacement_1_m.push_back(striker_d_);
  trace_.displacement_2_m.push_back(contact_.dot(d_) + setup_.residual_flexibility_m_per_N * force_);
  trace_.work_1_J.push_back(work_1_);
  trace_.work_2_J.push_back(work_2_);
}

double ImplicitImpact::total_energy() const {
  return setup_.striker_mass_kg * striker_v_ * striker_v_ / 2 + v_.dot(equations_->mass_times(v_)) / 2 +
         equations_->elastic_energy(d_) + law_contact_.residual_J() + trace_.stored_J.back() +
         trace_.dissipated_J.back();
}

}  // namespace impulse
