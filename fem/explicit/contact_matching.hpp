#pragma once

#include "fem/explicit/explicit_impact.hpp"
#include "fem/explicit/striking_body.hpp"

#include <cstddef>

namespace impulse {

/// How the force begins in a step: where the last one ended, or (first step only) as it ends.
enum class StepForce { ramp, held };

/// Two bodies whose faces move together at the end of every step: finds the force that makes them, by the impact's
/// `matching`. Keeps references to the structures and the impact.
/// Verified by: tests/fem/explicit_impact.test.cpp, tests/fem/explicit_contact.test.cpp
class ContactMatching {
 public:
  ContactMatching(const Structure& projectile, const Structure& target, const ExplicitImpact& impact);

  /// Takes both bodies through a step and returns the force at its end [N].
  /// @throws ConvergenceError if bisection misses 1e-12 of V/(½Δt Σ cᵀM⁻¹c), about the first force.
  double step(double begin_force, StepForce shape);

  /// Makes the faces of two bodies that have just been taken through a step without force move together from its end
  /// on, and returns the force there [N].
  double close();

  /// How fast the faces approach each other [m/s].
  [[nodiscard]] double closing_speed() const;

  [[nodiscard]] std::size_t trial_count() const { return trial_count_; }

  StrikingBody projectile;
  StrikingBody target;

 private:
  double step_directly(double begin_force, StepForce shape);
  double step_by_bisection(double begin_force, StepForce shape);
  double correct(double trial_force, const UnitResponse& unit_1, const UnitResponse& unit_2);
  void integrate(double begin_force, double end_force);

  const ExplicitImpact& impact_;
  UnitResponse ramp_1_;
  UnitResponse ramp_2_;
  double force_scale_;  // what V meets if only the faces' lumped masses gave way, to a factor V Z₁Z₂/(Z₁+Z₂) [N]
  double increment_;    // of the last step, where bisection looks first
  Snapshot before_1_;
  Snapshot before_2_;
  std::size_t trial_count_ = 0;
};

}  // namespace impulse
