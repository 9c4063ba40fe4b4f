#pragma once

#include "lib/model/structure.hpp"

#include <Eigen/Dense>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// A body of an explicit computation. The first of a row comes from one side, speeds count in the direction from it to
/// the last.
struct ExplicitBody {
  Structure structure;
  double speed_m_per_s = 0;   ///< of every point before impact
  std::size_t subcycles = 1;  ///< m ≥ 1: the body's step is the row's over m
};

/// Which contacts of which bodies meet: side 1 belongs to the earlier body of the row.
struct RowJoint {
  std::size_t body_1;
  Eigen::Index contact_1;
  std::size_t body_2;
  Eigen::Index contact_2;
};

/// Two bodies with p contacts each: contact i of one meets contact i of the other. A row of more: the inner bodies have
/// two contacts, entry and exit, the ends have one.
/// @throws std::invalid_argument for other numbers of contacts.
[[nodiscard]] std::vector<RowJoint> row_joints(const std::vector<ExplicitBody>& bodies);

/// Rigid motion r of the body with c₁ᵀr = 1; none if it is held or turns.
[[nodiscard]] std::optional<Eigen::VectorXd> rigid_translation(const Structure& body);

/// `projectile`, `target`, and `2nd body` between them, for messages.
[[nodiscard]] std::string body_name(std::size_t index, std::size_t body_count);

/// @throws std::invalid_argument, with a way out, if sizes disagree, a body that moves is held or its contacts do not
/// move with it, subcycles are 0, or a body's step is not stable.
void require_valid(const std::vector<ExplicitBody>& bodies, double step_s);

/// H(0+) if it is known: that of the continuous body, or none of a rigid one.
[[nodiscard]] std::optional<Eigen::MatrixXd> known_wave_admittance(const Structure& body);

}  // namespace impulse
