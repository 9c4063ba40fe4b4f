#pragma once

#include "fem/explicit/central_difference.hpp"
#include "lib/model/structure.hpp"

#include <Eigen/Dense>

#include <cstddef>
#include <optional>
#include <vector>

namespace impulse {

/// Motion of a body at one time, with what its dashpots have taken.
struct Snapshot {
  MotionState motion;
  double dissipated_J = 0;
};

/// Force on a contact through a step of the row: linear from begin to end; or, with `zero_at`, from begin to zero at
/// that fraction of the step.
struct StepLoad {
  double begin_N = 0;
  double end_N = 0;
  std::optional<double> zero_at = std::nullopt;
};

/// One body of an explicit impact between the steps of the row: its motion (departure from the flight before impact),
/// taken through a step by its own `subcycles` steps. Keeps a reference to the structure.
/// Verified by: tests/fem/explicit_impact.test.cpp, tests/fem/explicit_contacts.test.cpp
class StrikingBody {
 public:
  StrikingBody(const Structure& body, double step_s, std::size_t subcycles);

  /// Acceleration under these forces on the contacts from now on; before the first step.
  void set_forces(const Eigen::VectorXd& forces);

  /// Takes a constant force out of the acceleration that it put there: what set_forces without it would find, for less.
  void drop_force(Eigen::Index contact, double force) {
    now.motion.acceleration -= force * acceleration_per_force_.col(contact);
  }

  /// Through a step of the row, one load a contact. A load that reaches zero inside the step has its samples scaled so
  /// that the trapezoidal sum over the body's own steps is the triangle's area.
  void integrate(const std::vector<StepLoad>& loads);

  [[nodiscard]] Eigen::Index contact_count() const { return contacts_.cols(); }

  /// Of the contacts, into the body [m/s].
  [[nodiscard]] Eigen::VectorXd face_velocity() const { return contacts_.transpose() * now.motion.velocity; }

  /// Of the contacts, into the body [m/s²].
  [[nodiscard]] Eigen::VectorXd face_acceleration() const { return contacts_.transpose() * now.motion.acceleration; }

  /// Of the contacts, into the body, but for the residual flexibility [m].
  [[nodiscard]] Eigen::VectorXd face_displacement() const { return contacts_.transpose() * now.motion.displacement; }

  /// vᵀCv [W].
  [[nodiscard]] double dashpot_power() const;

  /// cᵀM⁻¹c [1/kg]: how fast a face moves under a unit force when nothing behind it does.
  [[nodiscard]] double face_mobility(Eigen::Index contact) const {
    return contacts_.col(contact).dot(acceleration_per_force_.col(contact));
  }

  [[nodiscard]] double kinetic_energy() const;
  [[nodiscard]] double strain_energy() const;

  /// rᵀMv [N s], with the translation r of the body.
  [[nodiscard]] double momentum(const Eigen::VectorXd& translation) const;

  /// What the contact forces have done on the departure [J]: the energy that central differences conserve in free
  /// flight, ½vᵀMv + ½dᵀKd - (δ²/8) aᵀMa with the body's own step δ, and the dissipation. The last term is of order δ²
  /// in smooth motion; it takes out the zigzag (-1)^(j+n) between the nodes, which at Courant number 1 moves freely and
  /// shows in the strain but does no work.
  [[nodiscard]] double received_work() const;

  [[nodiscard]] double step_s() const { return stepper_.step_s(); }
  [[nodiscard]] std::size_t step_count() const { return step_count_; }
  [[nodiscard]] const Structure& structure() const { return structure_; }

  Snapshot now;  ///< read and written by whoever repeats a step

 private:
  [[nodiscard]] double release_sample(const StepLoad& load, std::size_t substep) const;
  void fill_load(const Eigen::VectorXd& forces);

  const Structure& structure_;
  Eigen::SparseMatrix<double> contacts_;
  Eigen::MatrixXd acceleration_per_force_;  // M⁻¹c
  CentralDifference stepper_;
  std::size_t subcycles_;
  std::size_t step_count_ = 0;
  Eigen::VectorXd load_;    // zero where no contact is
  Eigen::VectorXd forces_;  // of the contacts
};

/// Response of a body at rest to the force of one step on one contact, of which only the degrees of freedom that moved
/// are kept. Verified by: tests/fem/explicit_impact.test.cpp
class UnitResponse {
 public:
  /// The force goes from `begin_force` to 1 through the step, from rest.
  UnitResponse(const StrikingBody& body, Eigen::Index contact, double begin_force);

  /// Adds `force` times the response to the body's motion.
  void add_to(StrikingBody& body, double force) const;

  [[nodiscard]] const Eigen::VectorXd& face_velocity() const { return face_velocity_; }
  [[nodiscard]] const Eigen::VectorXd& face_displacement() const { return face_displacement_; }

 private:
  Eigen::Index first_ = 0;
  MotionState motion_;
  Eigen::VectorXd face_velocity_;
  Eigen::VectorXd face_displacement_;
};

}  // namespace impulse
