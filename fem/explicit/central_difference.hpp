#pragma once

#include "fem/explicit/mass_solver.hpp"
#include "lib/model/structure.hpp"

#include <Eigen/Dense>

#include <functional>

namespace impulse {

/// f(d) [N], written into a vector of the right size: the internal force of a body, linear or not.
using InternalForce = std::function<void(const Eigen::VectorXd& displacement, Eigen::VectorXd& force)>;

/// f(d) = Kd. A tridiagonal K is applied as springs between neighbours, whose forces cancel to the last bit in the sum;
/// any other as a sparse matrix.
[[nodiscard]] InternalForce linear_internal_force(const Eigen::SparseMatrix<double>& stiffness);

/// State of motion at one time: displacement [m], velocity [m/s], acceleration [m/s²].
struct MotionState {
  Eigen::VectorXd displacement;
  Eigen::VectorXd velocity;
  Eigen::VectorXd acceleration;

  [[nodiscard]] static MotionState at_rest(Eigen::Index dof_count);
};

/// Explicit central differences with mass M, diagonal dashpots C and a load p [N]:
///
///   d ← d + Δt v + ½Δt² a_old
///   v ← v + ½Δt (a_old + a_new),   M a_new = p - f(d) - C v_new
///
/// C acts on the new velocity, (M + ½Δt C) a_new = p - f(d) - C (v + ½Δt a_old); dashpots therefore do not lower the
/// stability limit Δt ≤ 2/ω_max. Lumped mass divides; consistent mass is factorised once. Order 2. A load sampled at
/// t_k acts on [t_k-1, t_k+1] with the weight Δt: a jump that falls on a sample is its mean of both sides. Without
/// elements fixed to the ground momentum changes by ½Δt(p_old + p_new). With lumped mass no allocation after
/// construction.
/// @throws std::invalid_argument on construction unless sizes agree and step and masses are positive.
/// Verified by: tests/fem/central_difference.test.cpp
class CentralDifference {
 public:
  /// `dashpots` may be empty. Does not look at stability: see require_stable_step.
  CentralDifference(const Eigen::SparseMatrix<double>& mass, const Eigen::VectorXd& dashpots,
                    InternalForce internal_force, double step_s);

  /// Linear body: its mass, dashpots and stiffness.
  CentralDifference(const Structure& body, double step_s);

  /// Acceleration of the state under this load; to be called once before the first step, and wherever the load jumps.
  void set_load(MotionState& state, const Eigen::VectorXd& load);

  /// One step, `load` at its end.
  void advance(MotionState& state, const Eigen::VectorXd& load);

  [[nodiscard]] double step_s() const { return step_s_; }

 private:
  double step_s_;
  Eigen::VectorXd dashpots_;  // empty if there are none
  MassSolver mass_;
  MassSolver damped_mass_;  // M + ½Δt C
  InternalForce internal_force_;
  Eigen::VectorXd unbalanced_;
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
