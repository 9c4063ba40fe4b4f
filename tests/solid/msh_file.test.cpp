#include "fem/mesh/msh_file.hpp"

#include "fem/bodies/axisymmetric_solid.hpp"
#include "lib/contract/errors.hpp"
#include "tests/support/about.hpp"
#include "tests/support/temporary_directory.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <string>

namespace impulse {
namespace {

/// Two triangles of second order (one of them clockwise) make the rectangle 0 ≤ r ≤ 2, 0 ≤ z ≤ 1; format 2.2.
const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string nodes =
    "$Nodes\n10\n1 0 0 0\n2 2 0 0\n3 2 1 0\n4 0 1 0\n5 1 0 0\n6 2 .5 0\n7 1 .5 0\n8 1 1 0\n9 0 .5 0\n99 7 7 "
    "0\n$EndNodes\n";
const std::string triangles = "$Elements\n2\n1 9 2 10 1 1 2 3 5 6 7\n2 9 2 20 2 1 4 3 9 8 7\n$EndElements\n";

struct MshFile {
  test::TemporaryDirectory directory;
  std::string path;
  explicit MshFile(const std::string& text) : path(directory.write("mesh.msh", text)) {}
};

TEST_CASE(
    "a .msh file of second-order triangles: regions by physical surface, counterclockwise, loose nodes left out") {
  const TriangleMesh mesh = read_msh(MshFile(head + nodes + triangles).path);
  CHECK(mesh.node_count() == 9);
  REQUIRE(mesh.element_count() == 2);
  CHECK(mesh.region == std::vector<std::size_t>{0, 1});
  AxisymmetricSolid solid{
      .mesh = mesh,
      .materials = {isotropic_elasticity({"light", 1e9, 1, 0.3}), isotropic_elasticity({"heavy", 1e9, 10, 0.3})},
      .contacts = {}};
  // The lower triangle's centroid is at r = 4/3, the upper one's at 2/3; each has the area 1.
  CHECK(mass_kg(solid) == about(2 * std::numbers::pi * (4.0 / 3 + 10 * 2.0 / 3)).epsilon(1e-14));
  CHECK(axisymmetric_structure(solid).structure.mass.rows() == 2 * 9 - 3);
}

void refuses(const std::string& text, const std::string& message) {
  const MshFile file(text);
  try {
    (void)read_msh(file.path);
    FAIL("accepted: ", message);
  } catch (const InputError& error) {
    const std::string what = error.what();
    CAPTURE(what);
    CHECK(what.find(file.path) == 0);
    CHECK(what.find(message) != std::string::npos);
  }
}

TEST_CASE("what is not a mesh of such triangles is refused") {
  refuses("", "is not a Gmsh mesh");
  refuses("Point(1) = {0, 0, 0};\n", "is not a Gmsh mesh");
  refuses(head + "$Nodes\nnonsense\n", "");
  refuses(head + nodes + "$Elements\n1\n1 15 2 0 1 1\n$EndElements\n", "there are no triangles");
  refuses(head + nodes + "$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n",
          "surface 1 has 1 elements of type Triangle 3 (3 nodes); only 6-node triangles are understood: mesh with "
          "triangles of second order (gmsh -2 -order 2)");
  refuses(head + nodes + "$Elements\n1\n1 3 2 0 1 1 2 3 4\n$EndElements\n", "Quadrilateral 4");
  std::string raised = nodes;
  raised.replace(raised.find("8 1 1 0"), 7, "8 1 1 3");
  refuses(head + raised + triangles, "node 8 is at z = 3 of Gmsh; draw the section in the plane z = 0 (x = r, y = z)");
  CHECK_THROWS_AS(read_msh("/nowhere/at/all.msh"), InputError);
}

TEST_CASE("a tangled mesh is refused by the element that is turned inside out") {
  std::string bent = nodes;
  bent.replace(bent.find("7 1 .5 0"), 8, "7 3 -2 0");
  const TriangleMesh mesh = read_msh(MshFile(head + bent + triangles).path);
  const AxisymmetricElasticity material = isotropic_elasticity({"steel", 206e9, 7780, 0.3});
  CHECK_THROWS_WITH(axisymmetric_structure({.mesh = mesh, .materials = {material, material}, .contacts = {}}),
                    doctest::Contains("a triangle is turned inside out near"));
}

}  // namespace
}  // namespace impulse
