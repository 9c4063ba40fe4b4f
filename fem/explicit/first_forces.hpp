#pragma once

#include "fem/explicit/joined_bodies.hpp"

#include <Eigen/Dense>

#include <cstddef>
#include <optional>
#include <vector>

namespace impulse {

/// Whether the first force of a contact is known: both bodies' H(0+) are, and not both zero.
[[nodiscard]] bool has_wave_admittance(const JoinedBodies& bodies, std::size_t contact);

/// Forces of rigid contacts that close at the same time with these speeds, H₀F = V with the wave admittances H(0+) of
/// the continuous bodies; 0 on the others. Nothing if an admittance is not known.
[[nodiscard]] std::optional<Eigen::VectorXd> first_forces(const JoinedBodies& bodies,
                                                          const std::vector<std::size_t>& closing,
                                                          const Eigen::VectorXd& speed);

/// What begins to act where rigid contacts close on a sample.
struct MeetingForces {
  Eigen::VectorXd acting_N;                     ///< more than before, on all that close or stick
  std::optional<Eigen::VectorXd> continuous_N;  ///< first_forces of those that close
};

/// With the velocity W_ij that a ramp to 1 N over a step on contact j takes back from i (JoinedBodies::mobility),
///
///   Σ_j W_ij x_j = v_i + ½Δt a_i   of all i that close or stick,
///
/// v the closing speed at the sample and a its derivative under the forces that act: the half step that follows brings
/// the faces to one velocity. Without subcycles x_i Δt/2 is what the faces' masses exchange in a plastic collision, and
/// with any other force the faces' velocity (d_n+1 - d_n)/Δt would alternate about zero from then on, and the force
/// with it.
/// Verified by: tests/fem/explicit_rigid_contact.test.cpp
[[nodiscard]] MeetingForces meeting_forces(const JoinedBodies& bodies, const std::vector<std::size_t>& closing,
                                           const std::vector<std::size_t>& sticking, double step_s);

/// Jumps of the faces' velocities into their bodies under these forces [m/s]: column 0 side 1, column 1 side 2 of each
/// contact.
[[nodiscard]] Eigen::MatrixX2d first_velocities(const JoinedBodies& bodies, const Eigen::VectorXd& forces);

}  // namespace impulse
