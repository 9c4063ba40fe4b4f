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

/// Jumps of the faces' velocities into their bodies under these forces [m/s]: column 0 side 1, column 1 side 2 of each
/// contact.
[[nodiscard]] Eigen::MatrixX2d first_velocities(const JoinedBodies& bodies, const Eigen::VectorXd& forces);

}  // namespace impulse
