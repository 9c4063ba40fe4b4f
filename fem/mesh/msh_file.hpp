#pragma once

#include "fem/mesh/triangle_mesh.hpp"

#include <string>

namespace impulse {

/// Reads the half section of a solid of revolution from a Gmsh file (`.msh`, any version Gmsh reads): x is r, y is z,
/// second-order triangles; the k-th physical surface by tag is region k - 1 (gmsh_triangles.hpp).
/// @throws InputError if it cannot be read, is not a Gmsh mesh, or holds something else.
/// Verified by: tests/solid/msh_file.test.cpp
[[nodiscard]] TriangleMesh read_msh(const std::string& path);

}  // namespace impulse
