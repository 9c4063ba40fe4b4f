#include "fem/mesh/gmsh_triangles.hpp"

#include "lib/contract/require.hpp"

#include <gmsh.h>

#include <map>
#include <utility>

namespace impulse {
namespace {

using Index = Eigen::Index;
constexpr int six_node_triangle = 9;  // Gmsh's number

struct Triangles {
  std::vector<std::size_t> tags;
  std::vector<std::size_t> nodes;
  std::vector<std::size_t> region;
};

void add_surface(Triangles& all, int surface, std::size_t region) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, 2, surface);
  for (std::size_t i = 0; i < types.size(); ++i) {
    if (types[i] != six_node_triangle) {
      std::string name;
      int dimension = 0, order = 0, node_count = 0, primary_count = 0;
      std::vector<double> coordinates;
      gmsh::model::mesh::getElementProperties(types[i], name, dimension, order, node_count, coordinates, primary_count);
      require(false,
              "surface {} has {} elements of type {} ({} nodes); only 6-node triangles are understood: mesh with "
              "triangles of second order (gmsh -2 -order 2)",
              surface, tags[i].size(), name, node_count);
    }
    all.tags.insert(all.tags.end(), tags[i].begin(), tags[i].end());
    all.nodes.insert(all.nodes.end(), nodes[i].begin(), nodes[i].end());
    all.region.insert(all.region.end(), tags[i].size(), region);
  }
}

Triangles all_triangles() {
  gmsh::vectorpair groups, surfaces;
  gmsh::model::getPhysicalGroups(groups, 2);
  gmsh::model::getEntities(surfaces, 2);
  std::map<int, std::size_t> region_of;  // surface tag → region
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::vector<int> members;
    gmsh::model::getEntitiesForPhysicalGroup(2, groups[g].second, members);
    for (const int surface : members) {
      const bool is_new = region_of.try_emplace(surface, g).second;
      require(is_new, "surface {} belongs to two physical surfaces; give it one material", surface);
    }
  }
  Triangles all;
  for (const auto& [dimension, surface] : surfaces) {
    const auto found = region_of.find(surface);
    require(groups.empty() || found != region_of.end(),
            "surface {} belongs to no physical surface, so its material is not known; add it to one", surface);
    add_surface(all, surface, groups.empty() ? 0 : found->second);
  }
  require(!all.tags.empty(), "there are no triangles; mesh the section in two dimensions");
  return all;
}

std::map<std::size_t, Eigen::Vector2d> all_nodes() {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  std::map<std::size_t, Eigen::Vector2d> places;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    require(coordinates[3 * i + 2] == 0,
            "node {} is at z = {} of Gmsh; draw the section in the plane z = 0 (x = r, y = z)", tags[i],
            coordinates[3 * i + 2]);
    places[tags[i]] = {coordinates[3 * i], coordinates[3 * i + 1]};
  }
  return places;
}

/// Twice the area.
double orientation(const TriangleMesh& mesh, Index e) {
  const Eigen::RowVector2d a = mesh.nodes.row(mesh.elements(e, 1)) - mesh.nodes.row(mesh.elements(e, 0));
  const Eigen::RowVector2d b = mesh.nodes.row(mesh.elements(e, 2)) - mesh.nodes.row(mesh.elements(e, 0));
  return a(0) * b(1) - a(1) * b(0);
}

}  // namespace

TriangleMesh gmsh_triangles(const GmshSession& session) {
  TriangleMesh mesh;
  session.run("the mesh cannot be used", [&] {
    const Triangles triangles = all_triangles();
    const std::map<std::size_t, Eigen::Vector2d> places = all_nodes();
    std::map<std::size_t, Index> number;  // in the order of first use, which depends on nothing else
    std::vector<Eigen::Vector2d> used;
    mesh.elements.resize(static_cast<Index>(triangles.tags.size()), 6);
    for (std::size_t i = 0; i < triangles.nodes.size(); ++i) {
      const auto [found, is_new] = number.try_emplace(triangles.nodes[i], static_cast<Index>(used.size()));
      if (is_new) used.push_back(places.at(triangles.nodes[i]));
      mesh.elements(static_cast<Index>(i / 6), static_cast<Index>(i % 6)) = found->second;
    }
    mesh.nodes.resize(static_cast<Index>(used.size()), 2);
    for (std::size_t i = 0; i < used.size(); ++i) mesh.nodes.row(static_cast<Index>(i)) = used[i];
    mesh.region = triangles.region;
  });
  for (Index e = 0; e < mesh.element_count(); ++e) {
    if (orientation(mesh, e) >= 0) continue;
    std::swap(mesh.elements(e, 1), mesh.elements(e, 2));
    std::swap(mesh.elements(e, 3), mesh.elements(e, 5));
  }
  return mesh;
}

}  // namespace impulse
