#pragma once

#include "lib/model/structure.hpp"

#include <Eigen/Dense>

#include <functional>

namespace impulse {

/// f(d) [N], written into a vector of the right size: the internal force of a body, linear or not.
using InternalForce = std::function<void(const Eigen::VectorXd& displacement, Eigen::VectorXd& force)>;

/// f(d) = Kd. A tridiagonal K is applied as springs between neighbours, whose forces cancel to the last bit in the sum;
/// any other as a sparse matrix.
[[nodiscard]] InternalForce linear_internal_force(const Eigen::SparseMatrix<double>& stiffness);

/// The diagonal of a lumped mass matrix [kg].
/// @throws std::invalid_argument if M has another entry or a mass is not positive.
[[nodiscard]] Eigen::VectorXd lumped_mass(const Structure& body);

/// State of motion at one time: displacement [m], velocity [m/s], acceleration [m/s²].
struct MotionState {
  Eigen::VectorXd displacement;
  Eigen::VectorXd velocity;
  Eigen::VectorXd acceleration;

  [[nodiscard]] static MotionState at_rest(Eigen::Index dof_count);
};

/// Explicit central differences with lumped mass M, diagonal dashpots C and a load F·c:
///
///   d ← d + Δt v + ½Δt² a_old
///   v ← v + ½Δt (a_old + a_new),   M a_new = F c - f(d) - C v_new
///
/// C acts on the new velocity, which a diagonal solves point by point; dashpots therefore do not lower the stability
/// limit Δt ≤ 2/ω_max. Order 2. A force sampled at t_k acts on [t_k-1, t_k+1] with the weight Δt: a jump that falls on
/// a sample is its mean of both sides. Without elements fixed to the ground momentum changes by ½Δt(F_old + F_new).
/// No allocation after construction.
/// @throws std::invalid_argument on construction unless sizes agree and step and masses are positive.
/// Verified by: tests/fem/central_difference.test.cpp
class CentralDifference {
 public:
  /// `dashpots` may be empty. Does not look at stability: see require_stable_step.
  CentralDifference(const Eigen::VectorXd& mass, const Eigen::VectorXd& dashpots, InternalForce internal_force,
                    double step_s);

  /// Linear body: its lumped mass, dashpots and stiffness.
  CentralDifference(const Structure& body, double step_s);

  /// Acceleration of the state under the force F on contact vector c; to be called once before the first step, and
  /// wherever the force jumps.
  void set_force(MotionState& state, const Eigen::VectorXd& contact, double force_N);

  /// One step, F at its end.
  void advance(MotionState& state, const Eigen::VectorXd& contact, double end_force_N);

  [[nodiscard]] double step_s() const { return step_s_; }

 private:
  double step_s_;
  Eigen::VectorXd inverse_mass_;
  Eigen::VectorXd damping_rate_;      // C/M, empty if there are no dashpots
  Eigen::VectorXd velocity_divisor_;  // 1 + ½Δt C/M, likewise
  InternalForce internal_force_;
  Eigen::VectorXd internal_;
};

/// 2/ω_max [s] of K u = ω²M u, rounded down to be safe: λM - K is positive definite exactly if λ > ω_max², so bisection
/// on the success of its sparse Cholesky factorisation from the largest K_ii/M_ii upwards closes in
/// on ω_max², and the upper end is taken; infinite if there is no stiffness. Tight to a relative 1e-13 and rounding: a
/// free uniform rod gives h/c. Cost: about 45 factorisations. M may be consistent.
/// @throws std::invalid_argument if a mass is not positive.
/// Verified by: tests/fem/central_difference.test.cpp
[[nodiscard]] double stability_limit_s(const Structure& body);

/// Refuses a step beyond the stability limit by more than a relative 1e-12 (rounding of h/c; the highest mode then
/// grows by less than 3e-6 per step).
/// @throws std::invalid_argument "step 41 us exceeds the stability limit 39.8 us of the <name>; use --step 39.8us".
/// Verified by: tests/fem/central_difference.test.cpp
void require_stable_step(const Structure& body, double step_s, const char* name);

}  // namespace impulse
