#pragma once

#include "fem/explicit/joined_bodies.hpp"
#include "fem/explicit/law_contact.hpp"

#include <Eigen/Dense>

#include <cstddef>
#include <optional>
#include <vector>

namespace impulse {

/// Where the bodies are at the end of a trial step, in which the rigid contacts bore the force they began with and the
/// laws none.
struct TrialStep {
  Eigen::VectorXd closing_speed;  ///< of the contacts [m/s]
  Eigen::VectorXd approach_m;     ///< of the contacts, but for residual flexibility
};

/// What has to be added to a trial step.
struct StepForces {
  Eigen::VectorXd force_N;               ///< more at the end of the step (rigid), mean through it (law), else 0
  Eigen::VectorXd law_force_N;           ///< of the laws at the end of the step; else 0
  std::vector<LawContact::Answer> laws;  ///< one a contact, of those that have a law
};

/// The forces of one step with x_i on the contacts that stick and F̄_i on those with a law: with the mobilities W
/// (velocity) and D (displacement) of the step, closing speeds v and approaches a of the trial
///
///   v_i = Σ_stick W_ij x_j + Σ_law W_ij F̄_j                                           of every contact that sticks,
///   α_i + R_ii f_i(α_i) = a_i - Σ_law D_ij F̄_j - Σ_stick D_ij x_j - Σ_j≠i R_ij f_j     of every contact with a law,
///
/// F̄_i as LawContact says. The x_j are eliminated; what remains is iterated contact by contact where several laws feel
/// each other within a step, which for one law ends at once.
/// @throws ConvergenceError if 500 rounds do not bring the forces to rest within 2e-11 of the largest.
/// Verified by: tests/fem/explicit_contacts.test.cpp
[[nodiscard]] StepForces step_forces(const JoinedBodies& bodies, const TrialStep& trial,
                                     const std::vector<std::size_t>& sticking, StepForce shape,
                                     const std::vector<std::optional<LawContact>>& laws);

/// Adds the forces to the motion of the bodies.
void apply(JoinedBodies& bodies, const StepForces& forces, StepForce shape,
           const std::vector<std::optional<LawContact>>& laws);

}  // namespace impulse
