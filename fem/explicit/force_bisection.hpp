#pragma once

#include "fem/explicit/joined_bodies.hpp"

#include <cstddef>

namespace impulse {

/// The published procedure for the one rigid contact of two bodies: bisection on the increment of the force over a
/// step, each evaluation a trial of both bodies, until their faces move together at its end.
class ForceBisection {
 public:
  ForceBisection(JoinedBodies& bodies, double step_s);

  /// Takes the bodies through a step and returns the force at its end [N].
  /// @throws ConvergenceError if it misses 1e-12 of V/(½Δt Σ cᵀM⁻¹c), about the first force.
  double step(double begin_force, StepForce shape);

  [[nodiscard]] std::size_t trial_count() const { return trial_count_; }

 private:
  JoinedBodies& bodies_;
  double force_scale_;  // what V meets if only the faces' masses gave way, to a factor V Z₁Z₂/(Z₁+Z₂) [N]
  double increment_;    // of the last step, where the search begins
  std::size_t trial_count_ = 0;
};

}  // namespace impulse
