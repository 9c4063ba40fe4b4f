#include "fem/bodies/frame_structure.hpp"

#include "fem/bodies/assembly.hpp"
#include "fem/elements/hermite_beam.hpp"
#include "lib/contract/require.hpp"

#include <array>
#include <cmath>

namespace impulse {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Where (u₁, u₂) and (w₁, θ₁, w₂, θ₂) stand in (u₁, w₁, θ₁, u₂, w₂, θ₂).
constexpr std::array<Eigen::Index, 2> axial_place{0, 3};
constexpr std::array<Eigen::Index, 4> bending_place{1, 2, 4, 5};

Matrix6 combined(const Eigen::Matrix2d& axial, const Eigen::Matrix4d& bending) {
  Matrix6 matrix = Matrix6::Zero();
  matrix(axial_place, axial_place) = axial;
  matrix(bending_place, bending_place) = bending;
  return matrix;
}

/// From (u, v, rotation) of the frame to (along, across, rotation) of the member.
Matrix6 turned(double cosine, double sine) {
  Eigen::Matrix3d node;
  node << cosine, sine, 0, -sine, cosine, 0, 0, 0, 1;
  Matrix6 both = Matrix6::Zero();
  both.topLeftCorner<3, 3>() = node;
  both.bottomRightCorner<3, 3>() = node;
  return both;
}

double length_of(const Frame& frame, const FrameMember& member) {
  const FrameJoint &a = frame.joints[member.from], &b = frame.joints[member.to];
  return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
}

void require_frame(const Frame& frame) {
  require(!frame.members.empty(), "a frame needs at least one member");
  for (std::size_t i = 0; i < frame.members.size(); ++i) {
    const FrameMember& member = frame.members[i];
    require(member.from < frame.joints.size() && member.to < frame.joints.size(),
            "member {} goes from joint {} to {}, but there are {} joints", i + 1, member.from, member.to,
            frame.joints.size());
    require(length_of(frame, member) > 0, "member {} has no length", i + 1);
    require(member.elements > 0, "member {} has no element", i + 1);
    require(member.axial_stiffness_N > 0 && member.bending_stiffness_Nm2 > 0 && member.mass_kg_per_m > 0,
            "member {}: EA {} N, EI {} N m2 and mass {} kg/m are not all positive", i + 1, member.axial_stiffness_N,
            member.bending_stiffness_Nm2, member.mass_kg_per_m);
  }
}

std::vector<Eigen::Index> held_dofs(const Frame& frame) {
  std::vector<Eigen::Index> held;
  for (std::size_t i = 0; i < frame.joints.size(); ++i) {
    const Eigen::Index held_count = frame.joints[i].support == JointSupport::none     ? 0
                                    : frame.joints[i].support == JointSupport::pinned ? 2
                                                                                      : 3;
    for (Eigen::Index d = 0; d < held_count; ++d) held.push_back(3 * static_cast<Eigen::Index>(i) + d);
  }
  return held;
}

}  // namespace

Structure frame_structure(const Frame& frame) {
  require_frame(frame);
  Eigen::Index node_count = static_cast<Eigen::Index>(frame.joints.size());
  for (const FrameMember& member : frame.members) node_count += static_cast<Eigen::Index>(member.elements) - 1;
  const FreeDofs dofs(3 * node_count, held_dofs(frame));
  MatrixAssembly stiffness(dofs), mass(dofs);
  Eigen::Index next_inner = static_cast<Eigen::Index>(frame.joints.size());
  for (const FrameMember& member : frame.members) {
    const FrameJoint &a = frame.joints[member.from], &b = frame.joints[member.to];
    const double length = length_of(frame, member), h = length / static_cast<double>(member.elements);
    const double line_mass = member.mass_kg_per_m * h / 6;
    const Eigen::Matrix2d axial_stiffness = member.axial_stiffness_N / h * Eigen::Matrix2d{{1, -1}, {-1, 1}};
    const Eigen::Matrix2d axial_mass = line_mass * Eigen::Matrix2d{{2, 1}, {1, 2}};
    const Matrix6 turn = turned((b.x_m - a.x_m) / length, (b.y_m - a.y_m) / length);
    const Matrix6 k =
        turn.transpose() * combined(axial_stiffness, hermite_beam_stiffness(member.bending_stiffness_Nm2, h)) * turn;
    const Matrix6 m =
        turn.transpose() * combined(axial_mass, hermite_beam_consistent_mass(member.mass_kg_per_m, h)) * turn;
    Eigen::Index from = static_cast<Eigen::Index>(member.from);
    for (std::size_t e = 0; e < member.elements; ++e) {
      const Eigen::Index to = e + 1 < member.elements ? next_inner++ : static_cast<Eigen::Index>(member.to);
      const std::array<Eigen::Index, 6> places{3 * from, 3 * from + 1, 3 * from + 2, 3 * to, 3 * to + 1, 3 * to + 2};
      stiffness.add(places, k);
      mass.add(places, m);
      from = to;
    }
  }
  Structure body;
  body.stiffness = stiffness.matrix();
  body.mass = mass.matrix();
  body.contacts = Eigen::MatrixXd::Zero(dofs.count(), 0);
  body.outputs = Eigen::MatrixXd::Zero(dofs.count(), 0);
  body.wave_admittance = Eigen::MatrixXd::Zero(0, 0);
  return body;
}

}  // namespace impulse
