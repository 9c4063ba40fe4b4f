#include "fem/bodies/axisymmetric_solid.hpp"

#include "fem/elements/axisymmetric_triangle.hpp"
#include "lib/contract/require.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace impulse {
namespace {

using Index = Eigen::Index;
using Triplets = std::vector<Eigen::Triplet<double>>;

constexpr std::array<std::array<Index, 3>, 3> sides{{{0, 1, 3}, {1, 2, 4}, {2, 0, 5}}};  // ends, middle

/// Places of mesh nodes to rounding.
class Places {
 public:
  explicit Places(const TriangleMesh& mesh)
      : mesh_(mesh),
        tolerance_(1e-7 * (mesh.nodes.colwise().maxCoeff() - mesh.nodes.colwise().minCoeff()).norm()),
        z_a_(mesh.nodes.col(1).minCoeff()),
        z_b_(mesh.nodes.col(1).maxCoeff()) {}

  [[nodiscard]] bool on_axis(Index node) const { return std::abs(mesh_.nodes(node, 0)) <= tolerance_; }
  [[nodiscard]] bool on_face(Index node, Face face) const {
    return std::abs(mesh_.nodes(node, 1) - (face == Face::a ? z_a_ : z_b_)) <= tolerance_;
  }
  [[nodiscard]] double r(Index node) const { return mesh_.nodes(node, 0); }
  [[nodiscard]] double tolerance() const { return tolerance_; }

 private:
  const TriangleMesh& mesh_;
  double tolerance_;
  double z_a_;
  double z_b_;
};

void require_mesh(const AxisymmetricSolid& solid) {
  const TriangleMesh& mesh = solid.mesh;
  require(mesh.element_count() > 0, "a solid needs at least one element");
  require(static_cast<Index>(mesh.region.size()) == mesh.element_count(), "{} regions for {} elements",
          mesh.region.size(), mesh.element_count());
  require(mesh.nodes.allFinite(), "a node of the mesh has a coordinate that is not finite");
  require(mesh.elements.minCoeff() >= 0 && mesh.elements.maxCoeff() < mesh.node_count(),
          "an element names a node that the mesh does not have");
  const std::size_t regions = 1 + *std::ranges::max_element(mesh.region);
  require(regions <= solid.materials.size(), "the mesh has {} regions, but there are {} materials; give one for each",
          regions, solid.materials.size());
  Eigen::VectorX<bool> used = Eigen::VectorX<bool>::Constant(mesh.node_count(), false);
  for (Index e = 0; e < mesh.element_count(); ++e)
    for (const Index node : mesh.elements.row(e)) used(node) = true;
  require(used.all(), "the mesh has a node that belongs to no element");
}

const char* name_of(Face face) { return face == Face::a ? "A" : "B"; }

/// Nodes of a circle from the axis outwards.
std::vector<Index> circle_nodes(const TriangleMesh& mesh, const Places& places, const SolidContact& contact) {
  require(std::isfinite(contact.radius_m) && contact.radius_m > 0, "contact radius {} m is not positive",
          contact.radius_m);
  std::vector<Index> face;
  for (Index node = 0; node < mesh.node_count(); ++node)
    if (places.on_face(node, contact.face)) face.push_back(node);
  std::ranges::sort(face, {}, [&](Index node) { return places.r(node); });
  const double edge = contact.radius_m + places.tolerance();
  require(places.r(face.back()) >= contact.radius_m - places.tolerance(),
          "contact radius {:.6g} m is larger than face {}, whose radius is {:.6g} m; use that or less",
          contact.radius_m, name_of(contact.face), places.r(face.back()));
  const auto outside = std::ranges::find_if(face, [&](Index node) { return places.r(node) > edge; });
  face.erase(outside, face.end());
  require(!face.empty() && places.on_axis(face.front()),
          "face {} has no node on the axis, where a circle of contact has its middle", name_of(contact.face));
  require(
      places.r(face.back()) >= contact.radius_m - places.tolerance(),
      "no node of the mesh lies on the circle of contact (radius {:.6g} m; the last one inside is at {:.6g} m); put "
      "one there or use that radius",
      contact.radius_m, places.r(face.back()));
  return face;
}

/// A contact with the nodes of its circle and what lies behind it.
struct Circle {
  SolidContact contact;
  std::vector<Index> nodes;
  Eigen::VectorXd load;  // of each node under a unit force spread uniformly
  double wave_admittance = 0;
};

Circle circle_of(const AxisymmetricSolid& solid, const Places& places, const SolidContact& contact) {
  const TriangleMesh& mesh = solid.mesh;
  Circle circle{contact, circle_nodes(mesh, places, contact), {}, 0};
  Eigen::VectorXd load = Eigen::VectorXd::Zero(mesh.node_count());
  const std::set<Index> inside(circle.nodes.begin(), circle.nodes.end());
  std::set<std::size_t> regions;
  for (Index e = 0; e < mesh.element_count(); ++e)
    for (const auto& side : sides) {
      const std::array<Index, 3> nodes{mesh.elements(e, side[0]), mesh.elements(e, side[1]), mesh.elements(e, side[2])};
      if (!std::ranges::all_of(nodes, [&](Index node) { return inside.contains(node); })) continue;
      const Eigen::Vector3d part = axisymmetric_side_load(places.r(nodes[0]), places.r(nodes[1]));
      for (std::size_t i = 0; i < 3; ++i) load(nodes[i]) += part(static_cast<Index>(i));
      regions.insert(mesh.region[static_cast<std::size_t>(e)]);
    }
  const double area = std::numbers::pi * contact.radius_m * contact.radius_m;
  require(regions.size() == 1, "the circle of contact on face {} straddles {} materials; it must lie on one",
          name_of(contact.face), regions.size());
  circle.load = load(circle.nodes) / load.sum();
  if (contact.kind != CircleContact::nodes) {
    const AxisymmetricElasticity& material = solid.materials[*regions.begin()];
    circle.wave_admittance = 1 / (material.density_kg_per_m3 * material.axial_wave_speed_m_per_s() * area);
  }
  return circle;
}

/// Numbers the freedoms: none on the axis across it nor where a face is held; one for all nodes under a punch.
Eigen::Matrix<Index, Eigen::Dynamic, 2> numbered_freedoms(const AxisymmetricSolid& solid, const Places& places,
                                                          const std::vector<Circle>& circles, Index& count) {
  const TriangleMesh& mesh = solid.mesh;
  constexpr Index unset = -2;
  Eigen::Matrix<Index, Eigen::Dynamic, 2> freedoms =
      Eigen::Matrix<Index, Eigen::Dynamic, 2>::Constant(mesh.node_count(), 2, unset);
  for (Index node = 0; node < mesh.node_count(); ++node) {
    if (places.on_axis(node)) freedoms(node, 0) = -1;
    for (const auto& [face, support] : {std::pair{Face::a, solid.end_a}, {Face::b, solid.end_b}})
      if (support != EndSupport::free && places.on_face(node, face)) {
        freedoms(node, 1) = -1;
        if (support == EndSupport::fixed) freedoms(node, 0) = -1;
      }
  }
  count = 0;
  for (const Circle& circle : circles)
    if (circle.contact.kind == CircleContact::punch) {
      for (const Index node : circle.nodes) freedoms(node, 1) = count;
      ++count;
    }
  for (Index node = 0; node < mesh.node_count(); ++node)
    for (Index direction = 0; direction < 2; ++direction)
      if (freedoms(node, direction) == unset) freedoms(node, direction) = count++;
  return freedoms;
}

void add(Triplets& sum, const std::array<Index, 12>& freedoms, const TriangleMatrix& element) {
  for (Index i = 0; i < 12; ++i)
    for (Index j = 0; j < 12; ++j) {
      const Index row = freedoms[static_cast<std::size_t>(i)], column = freedoms[static_cast<std::size_t>(j)];
      if (row >= 0 && column >= 0 && element(i, j) != 0) sum.emplace_back(row, column, element(i, j));
    }
}

TriangleNodes element_nodes(const TriangleMesh& mesh, Index e) {
  TriangleNodes nodes;
  for (Index i = 0; i < 6; ++i) nodes.row(i) = mesh.nodes.row(mesh.elements(e, i));
  return nodes;
}

void assemble(const AxisymmetricSolid& solid, SolidStructure& body, Index freedom_count) {
  const TriangleMesh& mesh = solid.mesh;
  Triplets stiffness, mass;
  stiffness.reserve(static_cast<std::size_t>(144 * mesh.element_count()));
  mass.reserve(static_cast<std::size_t>((solid.mass == MassMatrix::lumped ? 12 : 72) * mesh.element_count()));
  for (Index e = 0; e < mesh.element_count(); ++e) {
    const AxisymmetricElasticity& material = solid.materials[mesh.region[static_cast<std::size_t>(e)]];
    const TriangleNodes nodes = element_nodes(mesh, e);
    std::array<Index, 12> freedoms{};
    for (Index i = 0; i < 6; ++i) {
      const Index node = mesh.elements(e, i);
      freedoms[static_cast<std::size_t>(2 * i)] = body.freedoms(node, 0);
      freedoms[static_cast<std::size_t>(2 * i + 1)] = body.freedoms(node, 1);
    }
    try {
      add(stiffness, freedoms, axisymmetric_triangle_stiffness(nodes, material));
      if (solid.mass == MassMatrix::lumped)
        add(mass, freedoms,
            axisymmetric_triangle_lumped_mass(nodes, material.density_kg_per_m3).asDiagonal().toDenseMatrix());
      else
        add(mass, freedoms, axisymmetric_triangle_consistent_mass(nodes, material.density_kg_per_m3));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("element {}: {}", e + 1, error.what()));
    }
  }
  body.structure.stiffness.resize(freedom_count, freedom_count);
  body.structure.stiffness.setFromTriplets(stiffness.begin(), stiffness.end());
  body.structure.mass.resize(freedom_count, freedom_count);
  body.structure.mass.setFromTriplets(mass.begin(), mass.end());
}

void add_contacts(const std::vector<Circle>& circles, SolidStructure& body, Index freedom_count) {
  std::vector<Eigen::VectorXd> columns;
  std::vector<double> admittance;
  const auto start_column = [&](double wave_admittance) -> Eigen::VectorXd& {
    admittance.push_back(wave_admittance);
    return columns.emplace_back(Eigen::VectorXd::Zero(freedom_count));
  };
  for (const Circle& circle : circles) {
    const double into = circle.contact.face == Face::a ? 1 : -1;
    body.contact_nodes.insert(body.contact_nodes.end(), circle.nodes.begin(), circle.nodes.end());
    if (circle.contact.kind == CircleContact::nodes) {
      for (const Index node : circle.nodes) start_column(0)(body.freedoms(node, 1)) = into;
      continue;
    }
    Eigen::VectorXd& column = start_column(circle.wave_admittance);
    if (circle.contact.kind == CircleContact::punch)
      column(body.freedoms(circle.nodes.front(), 1)) = into;
    else
      for (std::size_t i = 0; i < circle.nodes.size(); ++i)
        column(body.freedoms(circle.nodes[i], 1)) = into * circle.load(static_cast<Index>(i));
  }
  const auto count = static_cast<Index>(columns.size());
  body.structure.contacts.resize(freedom_count, count);
  for (Index i = 0; i < count; ++i) body.structure.contacts.col(i) = columns[static_cast<std::size_t>(i)];
  body.structure.wave_admittance = Eigen::Map<const Eigen::VectorXd>(admittance.data(), count).asDiagonal();
  body.structure.outputs = Eigen::MatrixXd::Zero(freedom_count, 0);
}

/// Along the axis, into the body at its first contact.
void add_translation(const AxisymmetricSolid& solid, SolidStructure& body, Index freedom_count) {
  if (solid.contacts.empty() || solid.end_a != EndSupport::free || solid.end_b != EndSupport::free) return;
  const double into = solid.contacts.front().face == Face::a ? 1 : -1;
  body.structure.translation = Eigen::VectorXd::Zero(freedom_count);
  for (const Index freedom : body.freedoms.col(1)) body.structure.translation(freedom) = into;
}

}  // namespace

void require_circle(const TriangleMesh& mesh, const SolidContact& contact) {
  (void)circle_nodes(mesh, Places(mesh), contact);
}

Eigen::Matrix<double, Eigen::Dynamic, 2> SolidStructure::nodal(const Eigen::Ref<const Eigen::VectorXd>& u) const {
  return freedoms.unaryExpr([&u](Index freedom) { return freedom < 0 ? 0.0 : u(freedom); });
}

double mass_kg(const AxisymmetricSolid& solid) {
  require_mesh(solid);
  double mass = 0;
  for (Index e = 0; e < solid.mesh.element_count(); ++e) {
    const double density = solid.materials[solid.mesh.region[static_cast<std::size_t>(e)]].density_kg_per_m3;
    mass += axisymmetric_triangle_lumped_mass(element_nodes(solid.mesh, e), density).sum() / 2;
  }
  return mass;
}

SolidStructure axisymmetric_structure(const AxisymmetricSolid& solid) {
  require_mesh(solid);
  const Places places(solid.mesh);
  std::vector<Circle> circles;
  for (const SolidContact& contact : solid.contacts) {
    require((contact.face == Face::a ? solid.end_a : solid.end_b) == EndSupport::free,
            "face {} is held; a contact needs a free face", name_of(contact.face));
    circles.push_back(circle_of(solid, places, contact));
  }
  Index count = 0;
  SolidStructure body;
  body.freedoms = numbered_freedoms(solid, places, circles, count);
  assemble(solid, body, count);
  add_contacts(circles, body, count);
  add_translation(solid, body, count);
  return body;
}

}  // namespace impulse
