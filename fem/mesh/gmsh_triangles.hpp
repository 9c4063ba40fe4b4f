#pragma once

#include "fem/mesh/gmsh_session.hpp"
#include "fem/mesh/triangle_mesh.hpp"

namespace impulse {

/// The 6-node triangles of Gmsh's current model, x as r and y as z. Region k is the (k+1)-th physical surface by tag;
/// a model without physical surfaces is one region. Corners come out counterclockwise, nodes that no triangle uses are
/// left out.
/// @throws std::invalid_argument for surface elements of another type, a mesh off the plane z = 0 of Gmsh, a triangle
/// outside every physical surface while there are some, or no triangle at all.
[[nodiscard]] TriangleMesh gmsh_triangles(const GmshSession& session);

}  // namespace impulse
