#pragma once

#include "fem/explicit/central_difference.hpp"
#include "fem/implicit/step_equilibrium.hpp"
#include "lib/model/structure.hpp"

#include <Eigen/Dense>

#include <cstddef>
#include <memory>

namespace impulse {

/// Newmark's rule with constant average acceleration (β = 1/4, γ = 1/2) for M d̈ + C ḋ + f(d) = F(t):
///
///   d ← d + ½Δt (v_old + v_new),   v ← v + ½Δt (a_old + a_new),   M a_new + C v_new + f(d_new) = F_new
///
/// unconditionally stable and free of damping for a linear body, order 2; periods come out longer by (ωΔt)²/12.
/// The equilibrium of a step is a StepEquilibrium with the matrix K + 2C/Δt + 4M/Δt². M may be consistent.
/// @throws std::invalid_argument on construction for sizes that disagree, a step that is not positive, or a matrix that
/// is not positive definite. Verified by: tests/fem/newmark.test.cpp
class Newmark {
 public:
  /// Linear body, f(d) = Kd.
  Newmark(const Structure& body, double step_s);

  /// Nonlinear body, with the structure's K to iterate with; its tangent isn't known.
  Newmark(const Structure& body, InternalForce internal_force, double step_s, const EquilibriumOptions& options = {});

  Newmark(Newmark&&) noexcept;
  Newmark& operator=(Newmark&&) noexcept;
  ~Newmark();

  /// Acceleration of the state in equilibrium with this load: before the first step, and wherever the load jumps.
  /// Costs a factorisation of M at its first call.
  void set_load(MotionState& state, const Eigen::VectorXd& load);

  /// One step, with the load at its end. Returns the solutions it took, 1 for a linear body.
  /// @throws ConvergenceError if the iteration misses its tolerance; the state is then as before.
  std::size_t advance(MotionState& state, const Eigen::VectorXd& end_load);

  [[nodiscard]] double step_s() const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace impulse
