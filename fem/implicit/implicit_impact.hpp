#pragma once

#include "fem/explicit/law_contact.hpp"
#include "fem/implicit/motion_equations.hpp"
#include "fem/implicit/step_equilibrium.hpp"
#include "lib/law/contact_trace.hpp"

#include <Eigen/Dense>

#include <cstddef>
#include <memory>

namespace impulse {

/// How a body is taken through a step Δt.
enum class StepRule {
  newmark,     ///< constant average acceleration: M Δv/Δt + ½(f_old + f_new) = F̄ c, Δd = ½Δt (v_old + v_new)
  conserving,  ///< the same with the mean of f along the straight way from d_old to d_new
  wilson,      ///< linear acceleration over 1.4 Δt, equilibrium at its end
};

struct ImplicitImpactSetup {
  double striker_mass_kg = 0;
  double speed_m_per_s = 0;
  double step_s = 0;
  StepRule rule = StepRule::newmark;
  double residual_flexibility_m_per_N =
      0;  ///< ≥ 0: what the body yields statically beside its unknowns; not by Wilson's
  EquilibriumOptions equilibrium{.tolerance = 1e-8, .most_iterations = 40};
};

/// A rigid striker on an elastic body at rest, with a contact law; all three are solved together in each step.
///
/// Newmark's and the conserving rule let the constant force F̄ act through a step that LawContact asks for: what both
/// bodies lose to it is what the law's energy gains. A linear body then keeps the sum of all energies to rounding, with
/// any step. A nonlinear one does with the conserving rule, because the energy of a shell is quartic, so that two Gauss
/// points give the mean of the cubic f exactly; with Newmark's to the order of the step, 2. Wilson's rule has the law's
/// force at both ends of a step and dissipates: 1.4 is the parameter for which it is stable for any step.
/// A step's equilibrium is a StepEquilibrium.
/// The contact's displacement is cᵀq + R F with the residual flexibility R, its velocity is without R.
/// Periods of a mode come out longer by (ωΔt)²/12 with the first two. Order 2.
/// Reference: [BatheWilson1976]. Verified by: tests/fem/implicit_impact.test.cpp
class ImplicitImpact {
 public:
  /// `contact`: c with cᵀq the displacement in the direction of the impact. Keeps a reference to the equations.
  /// @throws std::invalid_argument for a rigid law, sizes that disagree or a setup out of range.
  ImplicitImpact(const MotionEquations& equations, const Eigen::VectorXd& contact, const ContactLaw& law,
                 const ImplicitImpactSetup& setup);

  /// @throws ConvergenceError that says when and what to change; the state is then as before.
  void advance();

  /// Goes on in other coordinates: the state in them, and equations and contact vector for them.
  void change_equations(const MotionEquations& equations, const Eigen::VectorXd& contact,
                        const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity);

  [[nodiscard]] double time_s() const { return time_s_; }
  [[nodiscard]] const Eigen::VectorXd& displacement() const { return d_; }
  [[nodiscard]] const Eigen::VectorXd& velocity() const { return v_; }
  [[nodiscard]] double force_N() const { return force_; }
  [[nodiscard]] bool in_contact() const { return in_contact_; }
  [[nodiscard]] std::size_t iteration_count() const;      ///< of all steps so far
  [[nodiscard]] std::size_t factorisation_count() const;  ///< of matrices of a step so far, 1 to begin with

  /// Of striker, body and law; the law's loss counts as present [J].
  [[nodiscard]] double total_energy() const;

  /// What the last step left unbalanced: F̄ c - f̄ - M Δv/Δt up to the tolerance for these equations.
  [[nodiscard]] double mean_force_N() const { return mean_force_; }
  [[nodiscard]] const Eigen::VectorXd& last_change_of_velocity() const { return change_of_velocity_; }

  /// One sample per step and the start.
  [[nodiscard]] const ContactTrace& trace() const { return trace_; }

 private:
  void step_mean_force();
  void step_wilson();
  [[nodiscard]] Eigen::VectorXd mean_internal_force(const Eigen::VectorXd& change, Eigen::VectorXd& end_force) const;
  [[nodiscard]] StepEquilibrium::Found found(const StepEquilibrium::Step& step);
  [[nodiscard]] double wilson_force(double free_approach, double compliance) const;
  [[nodiscard]] StepEquilibrium equilibrium() const;
  void record();

  const MotionEquations* equations_;
  Eigen::VectorXd contact_;
  ContactLaw law_;
  LawContact law_contact_;  // of the rules with a mean force
  LawHistory history_;      // of Wilson's
  ImplicitImpactSetup setup_;
  StepEquilibrium equilibrium_;
  std::size_t earlier_iterations_ = 0, earlier_factorisations_ = 0;  // of equations gone by
  Eigen::VectorXd d_, v_, a_, old_internal_, change_of_velocity_;
  double time_s_ = 0;
  double striker_d_ = 0, striker_v_ = 0;
  double force_ = 0, mean_force_ = 0, indentation_ = 0;
  double impulse_ = 0, work_1_ = 0, work_2_ = 0;
  bool in_contact_ = false;
  ContactTrace trace_;
};

}  // namespace impulse
