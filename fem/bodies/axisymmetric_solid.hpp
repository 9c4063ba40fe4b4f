#pragma once

#include "fem/bodies/bar_structure.hpp"
#include "fem/elements/axisymmetric_elasticity.hpp"
#include "fem/mesh/triangle_mesh.hpp"
#include "lib/material/profile.hpp"
#include "lib/model/structure.hpp"

#include <vector>

namespace impulse {

/// How a force meets the circle of contact.
enum class CircleContact {
  pressure,  ///< spread uniformly; the displacement that does its work, the mean over the circle
  punch,     ///< by a rigid flat without friction: all nodes of the circle move as one along the axis
  nodes      ///< at each node of the circle by itself: one contact per node, from the axis outwards
};

/// A circle of contact about the axis on an end face, which is the plane of the mesh's least (A) or greatest (B) z.
struct SolidContact {
  Face face = Face::a;
  double radius_m = 0;
  CircleContact kind = CircleContact::punch;
};

enum class EndSupport {
  free,
  fixed,   ///< no node of the face moves
  sliding  ///< u_z = 0 without shear: a plane of symmetry
};

/// A solid of revolution that moves without twist. Regions of the mesh index the materials.
struct AxisymmetricSolid {
  TriangleMesh mesh;
  std::vector<AxisymmetricElasticity> materials;
  std::vector<SolidContact> contacts;
  EndSupport end_a = EndSupport::free;
  EndSupport end_b = EndSupport::free;
  MassMatrix mass = MassMatrix::consistent;  ///< lumped: HRZ, see axisymmetric_triangle.hpp
};

/// @throws std::invalid_argument unless the circle of a contact is a line of nodes round the axis.
void require_circle(const TriangleMesh& mesh, const SolidContact& contact);

/// Volume integral of the density [kg].
[[nodiscard]] double mass_kg(const AxisymmetricSolid& solid);

/// Its matrices, and where in them the nodes are.
struct SolidStructure {
  Structure structure;
  Eigen::Matrix<Eigen::Index, Eigen::Dynamic, 2> freedoms;  ///< of u_r, u_z at each node; -1 where held
  std::vector<Eigen::Index> contact_nodes;  ///< nodes on the circles, contact by contact, from the axis outwards

  /// u_r, u_z at each node of a vector of the structure's size.
  [[nodiscard]] Eigen::Matrix<double, Eigen::Dynamic, 2> nodal(const Eigen::Ref<const Eigen::VectorXd>& u) const;
};

/// Contacts count into the body: +u_z on face A, -u_z on face B. On the axis u_r = 0. Wave admittance of pressure and
/// punch: 1/(ρ c_L π a²), a plane dilatational wave that the edge of the circle has not reached yet; of nodes 0
/// (unknown).
/// @throws std::invalid_argument if the mesh is tangled (naming the element), reaches across the axis or a region has
/// no material; if a circle is larger than its face, has no node on its edge, straddles materials or lies on a held
/// face. Cost: n log n in the number of elements. Verified by: tests/fem/axisymmetric_solid.test.cpp
[[nodiscard]] SolidStructure axisymmetric_structure(const AxisymmetricSolid& solid);

}  // namespace impulse
