#pragma once

#include "fem/mesh/triangle_mesh.hpp"
#include "lib/material/profile.hpp"

#include <vector>

namespace impulse {

/// A circle about the axis on an end face whose edge a mesh resolves and has a node on.
struct MeshedCircle {
  Face face = Face::a;
  double radius_m = 0;
  double size_m = 0;  ///< of the elements at its edge
};

struct SolidMeshOptions {
  double growth = 1.2;  ///< > 1; a distance d from the edge of a circle elements have the size + (growth - 1) d
  double largest_per_radius = 0.25;  ///< > 0; but nowhere more than this part of the body's radius there
};

/// @throws std::invalid_argument for an invalid chain and a circle larger than its face.
void require_circles(const Profile& profile, const std::vector<MeshedCircle>& circles);

/// 6-node triangles of half a meridian section of a chain of segments: end A at z = 0, r from the axis; region i is
/// segment i. Meshed by Gmsh (frontal Delaunay): the same input gives the same mesh.
/// See docs/decisions/0010-solid-meshes.md.
/// @throws std::invalid_argument for an invalid chain or option, a circle larger than its face, more than 10⁶ elements
/// by estimate. Verified by: tests/solid/solid_mesh.test.cpp
[[nodiscard]] TriangleMesh solid_mesh(const Profile& profile, const std::vector<MeshedCircle>& circles,
                                      const SolidMeshOptions& options = {});

}  // namespace impulse
