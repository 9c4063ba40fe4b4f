#include "fem/mesh/msh_file.hpp"

#include "fem/mesh/gmsh_triangles.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/input_file.hpp"

#include <gmsh.h>

#include <algorithm>

namespace impulse {

TriangleMesh read_msh(const std::string& path) {
  {
    // Gmsh takes any file for a script of its own, and runs it.
    InputFile file(path);
    std::string begin(11, '\0');
    begin.resize(file.read(begin.data(), begin.size()));
    if (!begin.starts_with("$MeshFormat"))
      throw InputError(path, 1, 0,
                       "is not a Gmsh mesh, which begins with $MeshFormat; export one with gmsh -2 -order 2");
  }
  try {
    const GmshSession session;
    session.run("Gmsh cannot read it", [&] { gmsh::open(path); });
    return gmsh_triangles(session);
  } catch (const std::invalid_argument& error) {
    throw InputError(path, 0, 0, error.what());
  }
}

}  // namespace impulse
