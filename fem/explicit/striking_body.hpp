#pragma once

#include "fem/explicit/central_difference.hpp"
#include "lib/model/structure.hpp"

#include <Eigen/Dense>

#include <cstddef>

namespace impulse {

/// Motion of a body at one time, with what its dashpots have taken.
struct Snapshot {
  MotionState motion;
  double dissipated_J = 0;
};

/// One body of an explicit impact between the target's steps: its motion (departure from the motion before impact),
/// taken through a step of the target by its own `subcycles` steps while the force goes linearly from begin to end.
/// Keeps a reference to the structure. Verified by: tests/fem/explicit_impact.test.cpp
class StrikingBody {
 public:
  StrikingBody(const Structure& body, double step_s, std::size_t subcycles);

  /// Acceleration under this force from now on; before the first step and where the force jumps.
  void set_force(double force) { stepper_.set_force(now.motion, contact_, force); }

  /// Takes a constant force out of the acceleration that it put there: what set_force(0) would find, for less.
  void drop_force(double force) { now.motion.acceleration -= force * face_acceleration_; }

  /// Through a step of the target.
  void integrate(double begin_force, double end_force);

  /// The force falls from `force` to zero at the fraction `part` of the step; the samples of that triangle are scaled
  /// so that the trapezoidal sum over the body's own steps is its area.
  void integrate_release(double force, double part);

  /// Into the body [m/s].
  [[nodiscard]] double face_velocity() const { return contact_.dot(now.motion.velocity); }

  /// Into the body [m].
  [[nodiscard]] double face_displacement() const { return contact_.dot(now.motion.displacement); }

  /// vᵀCv [W].
  [[nodiscard]] double dashpot_power() const;

  /// cᵀM⁻¹c [1/kg]: how fast the face moves under a unit force when nothing behind it does.
  [[nodiscard]] double face_mobility() const { return contact_.cwiseAbs2().cwiseQuotient(mass_).sum(); }

  /// Translation of the whole body that moves the face by 1 into it.
  [[nodiscard]] double translation() const { return 1 / contact_.sum(); }

  [[nodiscard]] double mass_kg() const { return mass_.sum(); }

  /// Of the departure, along the translation into the body [N s].
  [[nodiscard]] double momentum() const { return translation() * mass_.dot(now.motion.velocity); }

  [[nodiscard]] double kinetic_energy() const { return 0.5 * mass_.dot(now.motion.velocity.cwiseAbs2()); }

  [[nodiscard]] double strain_energy() const;

  /// What the contact force has done on the departure [J]: the energy that central differences conserve in free
  /// flight, ½vᵀMv + ½dᵀKd - (δ²/8) aᵀMa with the body's own step δ, and the dissipation. The last term is of order δ²
  /// in smooth motion; it takes out the zigzag (-1)^(j+n) between the nodes, which at Courant number 1 moves freely and
  /// shows in the strain but does no work.
  [[nodiscard]] double received_work() const;

  [[nodiscard]] double step_s() const { return stepper_.step_s(); }
  [[nodiscard]] std::size_t step_count() const { return step_count_; }

  Snapshot now;  ///< read and written by whoever repeats a step

 private:
  const Structure& structure_;
  Eigen::VectorXd contact_;
  Eigen::VectorXd mass_;
  Eigen::VectorXd face_acceleration_;  // M⁻¹c
  CentralDifference stepper_;
  std::size_t subcycles_;
  std::size_t step_count_ = 0;
};

/// Response of a body at rest to the force of one step, of which only the degrees of freedom that moved are
/// kept. Verified by: tests/fem/explicit_impact.test.cpp
class UnitResponse {
 public:
  /// The force goes from `begin_force` to 1 through the step, from rest.
  UnitResponse(const StrikingBody& body, double begin_force);

  /// Adds `force` times the response to the body's motion.
  void add_to(StrikingBody& body, double force) const;

  [[nodiscard]] double face_velocity() const { return face_velocity_; }
  [[nodiscard]] double face_displacement() const { return face_displacement_; }

 private:
  Eigen::Index first_ = 0;
  MotionState motion_;
  double face_velocity_ = 0;
  double face_displacement_ = 0;
};

}  // namespace impulse
