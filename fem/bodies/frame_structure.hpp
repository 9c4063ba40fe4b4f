#pragma once

#include "lib/model/structure.hpp"

#include <Eigen/Dense>

#include <cstddef>
#include <vector>

namespace impulse {

/// What holds a joint of a frame.
enum class JointSupport { none, pinned, clamped };

struct FrameJoint {
  double x_m = 0;
  double y_m = 0;
  JointSupport support = JointSupport::none;
};

/// A straight uniform member from one joint to another, rigidly connected at both.
struct FrameMember {
  std::size_t from = 0;
  std::size_t to = 0;
  double axial_stiffness_N = 0;      ///< EA
  double bending_stiffness_Nm2 = 0;  ///< EI
  double mass_kg_per_m = 0;          ///< ρA
  std::size_t elements = 1;
};

struct Frame {
  std::vector<FrameJoint> joints;
  std::vector<FrameMember> members;
};

/// Plane frame of members that stretch (linear elements) and bend (Hermite elements), both masses consistent. Three
/// degrees of freedom (u, v, rotation) a node; joints come first, in their order, then the members' inner nodes. It has
/// no contacts.
/// @throws std::invalid_argument if a joint does not exist, a member has no length or no element, or a stiffness or
/// mass is not positive. Verified by: tests/fem/frame_structure.test.cpp
[[nodiscard]] Structure frame_structure(const Frame& frame);

}  // namespace impulse
