#include "fem/mesh/solid_mesh.hpp"

#include "fem/bodies/axisymmetric_solid.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace impulse {
namespace {

const Profile cone{parse_segment("400mm,30mm,75mm,nylon-6:0.40")};

AxisymmetricSolid solid_of(const Profile& profile, const std::vector<MeshedCircle>& circles,
                           const SolidMeshOptions& options = {}) {
  AxisymmetricSolid solid{.mesh = solid_mesh(profile, circles, options), .materials = {}, .contacts = {}};
  for (const Segment& segment : profile) solid.materials.push_back(isotropic_elasticity(segment.material));
  for (const MeshedCircle& circle : circles) solid.contacts.push_back({circle.face, circle.radius_m});
  return solid;
}

/// Sides of one element only; in a conforming mesh they are the outline.
std::size_t outer_side_count(const TriangleMesh& mesh) {
  std::set<std::pair<Eigen::Index, Eigen::Index>> open;
  for (Eigen::Index e = 0; e < mesh.element_count(); ++e)
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(mesh.elements(e, k), mesh.elements(e, (k + 1) % 3));
      if (!open.erase({a, b})) open.insert({a, b});
    }
  return open.size();
}

TEST_CASE("a meshed chain has the mass of its segments, in the regions where they are, and stays whole at a step") {
  const Profile chain{parse_segment("50mm,20mm,nylon-6:0.4"), parse_segment("30mm,40mm,30mm,aluminium:0.33"),
                      parse_segment("40mm,30mm,steel:0.3")};
  const AxisymmetricSolid solid = solid_of(chain, {{Face::a, 4e-3, 0.5e-3}, {Face::b, 15e-3, 2e-3}});
  CHECK(mass_kg(solid) == about(mass_kg(chain)).epsilon(1e-13));  // straight sides: exact
  CHECK(*std::ranges::max_element(solid.mesh.region) == 2);
  for (Eigen::Index e = 0; e < solid.mesh.element_count(); ++e) {
    const double z = solid.mesh.nodes(solid.mesh.elements.row(e).head<3>(), 1).mean();
    CHECK(solid.mesh.region[static_cast<std::size_t>(e)] == (z < 0.05 ? 0 : z < 0.08 ? 1 : 2));
  }
  CHECK(axisymmetric_structure(solid).contact_nodes.size() > 10);
  // Euler: a disc of triangles has e sides with 3t = 2e - outer, v - e + t = 1, and v corners.
  std::set<Eigen::Index> corners;
  for (Eigen::Index e = 0; e < solid.mesh.element_count(); ++e)
    for (int k = 0; k < 3; ++k) corners.insert(solid.mesh.elements(e, k));
  const auto triangles = static_cast<std::size_t>(solid.mesh.element_count());
  const std::size_t sides = (3 * triangles + outer_side_count(solid.mesh)) / 2;
  CHECK(corners.size() + triangles == sides + 1);
  CHECK(static_cast<std::size_t>(solid.mesh.node_count()) == corners.size() + sides);
}

TEST_CASE("the circle's edge is on a node, elements there have the size asked for and grow from it") {
  for (const double size : {1e-3, 0.25e-3}) {
    const TriangleMesh mesh = solid_mesh(cone, {{Face::b, 5e-3, size}});
    double at_edge = 0, far = 0;
    for (Eigen::Index e = 0; e < mesh.element_count(); ++e)
      for (int k = 0; k < 3; ++k) {
        const Eigen::RowVector2d a = mesh.nodes.row(mesh.elements(e, k)),
                                 b = mesh.nodes.row(mesh.elements(e, (k + 1) % 3));
        const Eigen::RowVector2d edge(5e-3, 0.4);
        if ((a - edge).norm() < 1e-12 || (b - edge).norm() < 1e-12) at_edge = std::max(at_edge, (a - b).norm());
        far = std::max(far, (a - b).norm());
      }
    CHECK(at_edge > 0.5 * size);
    CHECK(at_edge < 1.7 * size);
    CHECK(far < 1.7 * 0.25 * 37.5e-3);
    CHECK(far > 0.7 * 0.25 * 37.5e-3);
  }
}

TEST_CASE("the same input makes the same mesh") {
  const TriangleMesh first = solid_mesh(cone, {{Face::b, 5e-3, 1e-3}});
  const TriangleMesh second = solid_mesh(cone, {{Face::b, 5e-3, 1e-3}});
  CHECK(first.nodes == second.nodes);
  CHECK(first.elements == second.elements);
}

TEST_CASE("the thesis' meshes: about 616 and 1305 elements") {
  // 3 %: another version of Gmsh may place a few more. Two and five sides on the radius: 5 and 11 loaded nodes.
  const TriangleMesh coarse = solid_mesh(cone, {{Face::b, 5e-3, 2.5e-3}}, {1.08, 0.32});
  const TriangleMesh fine = solid_mesh(cone, {{Face::b, 5e-3, 1e-3}}, {1.1, 0.21});
  CHECK(static_cast<double>(coarse.element_count()) == about(616).epsilon(0.03));
  CHECK(static_cast<double>(fine.element_count()) == about(1305).epsilon(0.03));
}

TEST_CASE("what cannot be meshed is refused") {
  CHECK_THROWS_WITH(solid_mesh(cone, {{Face::a, 20e-3, 1e-3}}),
                    "contact radius 0.02 m is larger than face A, whose radius is 0.015 m; use that or less");
  CHECK_THROWS_WITH(solid_mesh(cone, {{Face::a, 0, 1e-3}}), "contact radius 0 m is not positive");
  CHECK_THROWS_WITH(solid_mesh(cone, {{Face::a, 1e-3, 0}}), "mesh size 0 m at the contact is not positive");
  CHECK_THROWS_WITH(solid_mesh(cone, {}, {1, 0.5}), "growth 1 of the elements is not above 1");
  CHECK_THROWS_WITH(solid_mesh(cone, {}, {1.2, 0}), "largest element size 0 per radius is not positive");
  CHECK_THROWS_WITH(solid_mesh({}, {}), "a bar needs at least one segment");
  CHECK_THROWS_WITH(solid_mesh(cone, {{Face::a, 15e-3, 1e-6}}, {1.0001, 0.5}),
                    doctest::Contains("the mesh would have more than 1e+06 elements"));
}

}  // namespace
}  // namespace impulse
