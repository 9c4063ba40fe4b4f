#pragma once

#include "fem/explicit/explicit_bodies.hpp"
#include "fem/explicit/striking_body.hpp"

#include <Eigen/Dense>

#include <cstddef>
#include <vector>

namespace impulse {

/// How the force begins in a step: where the last one ended, or (first step only) as it ends.
enum class StepForce { ramp, held };

/// What unit forces through one step do to all p contacts by its end; column j is the force on contact j.
struct StepMobility {
  Eigen::MatrixXd velocity;      ///< closing speed taken back [m/s per N]
  Eigen::MatrixXd displacement;  ///< approach taken back [m per N]
};

/// The bodies of a row and what their contacts see of them. Keeps references to the structures.
class JoinedBodies {
 public:
  JoinedBodies(const std::vector<ExplicitBody>& bodies, double step_s);

  [[nodiscard]] std::size_t contact_count() const { return joints_.size(); }
  [[nodiscard]] const RowJoint& joint(std::size_t contact) const { return joints_[contact]; }

  /// Speed at which contact i closes before impact [m/s].
  [[nodiscard]] double flight_speed(std::size_t contact) const;

  /// Of the contacts, now [m/s].
  [[nodiscard]] Eigen::VectorXd closing_speed() const;

  /// How fast that changes under the forces that act now [m/s²].
  [[nodiscard]] Eigen::VectorXd closing_acceleration() const;

  /// How far the departures have taken the contacts back from the flight before impact, but for residual flexibility
  /// [m].
  [[nodiscard]] Eigen::VectorXd taken_back_m() const;

  /// Through a step, one load a contact.
  void integrate(const std::vector<StepLoad>& loads);

  /// Accelerations under these forces on the contacts from now on.
  void set_forces(const Eigen::VectorXd& forces);

  /// StrikingBody::drop_force on both bodies of a contact.
  void drop_force(std::size_t contact, double force);

  /// Adds to the motion at the end of a step what a force of this shape and end value on the contact would have done.
  void add(std::size_t contact, StepForce shape, double force);

  [[nodiscard]] const StepMobility& mobility(StepForce shape) const { return shape == StepForce::ramp ? ramp_ : held_; }

  /// Σ cᵀM⁻¹c of both faces [1/kg].
  [[nodiscard]] double face_mobility(std::size_t contact) const;

  /// Residual flexibility between contacts, both bodies' [m/N], p × p.
  [[nodiscard]] const Eigen::MatrixXd& residual_flexibility() const { return residual_; }

  /// Displacement into body `body` at its contact `contact`, residual flexibility under the forces of the joints
  /// included [m].
  [[nodiscard]] double face_displacement(std::size_t body, Eigen::Index contact, const Eigen::VectorXd& forces) const;

  [[nodiscard]] std::vector<Snapshot> state() const;
  void restore(const std::vector<Snapshot>& state);

  std::vector<StrikingBody> bodies;

 private:
  struct Pair {
    UnitResponse side_1;
    UnitResponse side_2;
  };
  [[nodiscard]] StepMobility mobility_of(const std::vector<Pair>& responses) const;
  void find_residual();
  [[nodiscard]] Eigen::VectorXd sum_of_faces(Eigen::VectorXd (StrikingBody::*motion)() const) const;

  std::vector<double> speeds_;
  std::vector<RowJoint> joints_;
  std::vector<std::vector<std::size_t>> joint_of_;  // body, its contact → contact of the row
  std::vector<Pair> ramps_;
  std::vector<Pair> helds_;
  StepMobility ramp_;
  StepMobility held_;
  Eigen::MatrixXd residual_;
  std::vector<StepLoad> body_loads_;
};

}  // namespace impulse
