#include "fem/bodies/axisymmetric_solid.hpp"

#include "lib/model/modal_model.hpp"
#include "tests/support/about.hpp"
#include "tests/support/section_mesh.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace impulse {
namespace {

constexpr double pi = std::numbers::pi;
const AxisymmetricElasticity steel = isotropic_elasticity({"steel", 206e9, 7780, 0.3});

AxisymmetricSolid disc(CircleContact kind, double contact_radius = 0.05) {
  return {
      .mesh = rectangle_mesh(0, 0.1, 0.08, 4, 3), .materials = {steel}, .contacts = {{Face::a, contact_radius, kind}}};
}

TEST_CASE("patch of distorted elements from the axis outwards: a homogeneous stress leaves no force inside") {
  AxisymmetricSolid solid = disc(CircleContact::nodes);
  solid.mesh = mapped_mesh(4, 4, [](double i, double j) {
    const double bend = i * (4 - i) * j * (4 - j);
    return Eigen::RowVector2d(0.1 * i + 0.003 * bend * std::sin(3 * i + j),
                              0.13 * j + 0.003 * bend * std::cos(i - 2 * j));
  });
  solid.contacts = {};
  const SolidStructure body = axisymmetric_structure(solid);
  Eigen::VectorXd u(body.structure.stiffness.rows());
  for (Eigen::Index node = 0; node < solid.mesh.node_count(); ++node) {
    if (body.freedoms(node, 0) >= 0) u(body.freedoms(node, 0)) = 2 * solid.mesh.nodes(node, 0);
    u(body.freedoms(node, 1)) = -3 * solid.mesh.nodes(node, 1);
  }
  const Eigen::VectorXd force = body.structure.stiffness * u;
  double inside = 0;
  for (Eigen::Index node = 0; node < solid.mesh.node_count(); ++node) {
    const double r = solid.mesh.nodes(node, 0), z = solid.mesh.nodes(node, 1);
    if (r > 0.399 || z < 0.001 || z > 0.519) continue;
    for (const Eigen::Index freedom : body.freedoms.row(node))
      if (freedom >= 0) inside = std::max(inside, std::abs(force(freedom)));
  }
  CHECK(inside <= 1e-13 * force.cwiseAbs().maxCoeff());
}

TEST_CASE("mass and one rigid motion: along the axis") {
  for (const MassMatrix mass : {MassMatrix::consistent, MassMatrix::lumped}) {
    AxisymmetricSolid solid = disc(CircleContact::pressure);
    solid.mass = mass;
    const ModalModel modes = modal_model(axisymmetric_structure(solid).structure, {.mode_count = 4});
    CHECK(modes.angular_frequency(0) == 0);
    CHECK(modes.angular_frequency(1) > 0);
    const double weight = 7780 * pi * 0.1 * 0.1 * 0.08;
    CHECK(std::pow(modes.participation(0, 0), -2) == about(weight).epsilon(1e-12));
  }
}

TEST_CASE("contacts count into the body, do unit work, and know the first answer of the continuum") {
  for (const Face face : {Face::a, Face::b})
    for (const CircleContact kind : {CircleContact::pressure, CircleContact::punch}) {
      AxisymmetricSolid solid = disc(kind);
      solid.contacts[0].face = face;
      const SolidStructure body = axisymmetric_structure(solid);
      Eigen::VectorXd shift = Eigen::VectorXd::Zero(body.structure.mass.rows());
      for (Eigen::Index node = 0; node < solid.mesh.node_count(); ++node) shift(body.freedoms(node, 1)) = 1;
      CHECK(body.structure.contacts.col(0).dot(shift) == about(face == Face::a ? 1 : -1).epsilon(1e-14));
      CHECK(body.structure.wave_admittance(0, 0) ==
            about(1 / (7780 * steel.axial_wave_speed_m_per_s() * pi * 0.05 * 0.05)).epsilon(1e-14));
      CHECK(body.contact_nodes.size() == 5);
    }
  const SolidStructure nodes = axisymmetric_structure(disc(CircleContact::nodes));
  CHECK(nodes.structure.contacts.cols() == 5);
  CHECK(nodes.structure.contacts.sum() == 5);
}

TEST_CASE("a punch is the limit of the nodes it ties: its flexibility is that of the condensed nodes") {
  // A rigid punch under the force F: node forces f with Σf = F and one displacement w, A f = w 1: w/F = 1/(1ᵀA⁻¹1).
  AxisymmetricSolid solid = disc(CircleContact::nodes);
  solid.end_b = EndSupport::fixed;
  const Structure nodes = axisymmetric_structure(solid).structure;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(nodes.stiffness);
  const Eigen::MatrixXd a = nodes.contacts.transpose() * factor.solve(nodes.contacts);
  const double condensed = 1 / a.llt().solve(Eigen::VectorXd::Ones(a.rows())).sum();
  solid.contacts[0].kind = CircleContact::punch;
  const Structure punch = axisymmetric_structure(solid).structure;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> tied(punch.stiffness);
  const double flexibility = punch.contacts.col(0).dot(Eigen::VectorXd(tied.solve(punch.contacts.col(0))));
  CHECK(flexibility == about(condensed).epsilon(1e-10));
  solid.contacts[0].kind = CircleContact::pressure;
  const Structure pressure = axisymmetric_structure(solid).structure;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> spread(pressure.stiffness);
  CHECK(pressure.contacts.col(0).dot(Eigen::VectorXd(spread.solve(pressure.contacts.col(0)))) > flexibility);
}

TEST_CASE("nodal values of a vector: zero where held, one for all nodes under a punch") {
  AxisymmetricSolid solid = disc(CircleContact::punch);
  solid.end_b = EndSupport::sliding;
  const SolidStructure body = axisymmetric_structure(solid);
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(body.structure.mass.rows(), 1, 2);
  const Eigen::MatrixX2d at = body.nodal(u);
  for (const Eigen::Index node : body.contact_nodes) CHECK(at(node, 1) == at(body.contact_nodes[0], 1));
  for (Eigen::Index node = 0; node < at.rows(); ++node) {
    CHECK((at(node, 0) == 0) == (solid.mesh.nodes(node, 0) == 0));
    CHECK((at(node, 1) == 0) == (solid.mesh.nodes(node, 1) == 0.08));
  }
}

/// First elastic frequencies [Hz] of NAFEMS FV41: free hollow cylinder, radii 1.8 and 2.2 m, length 10 m.
Eigen::VectorXd fv41_frequencies(int columns, int rows, Eigen::Index count) {
  const AxisymmetricSolid solid{.mesh = rectangle_mesh(1.8, 2.2, 10, columns, rows),
                                .materials = {isotropic_elasticity({"FV41", 200e9, 8000, 0.3})},
                                .contacts = {}};
  const ModalModel modes =
      modal_model(axisymmetric_structure(solid).structure, {.mode_count = static_cast<std::size_t>(count + 1)});
  return modes.angular_frequency.tail(count) / (2 * pi);
}

TEST_CASE(
    "NAFEMS FV41: the first six frequencies within 0.002 % of the converged ones of the same theory and 0.05 % of "
    "the published ones") {
  // Converged p-Ritz values of the same theory; the published ones are up to 0.03 % off them.
  const Eigen::VectorXd converged = Eigen::Vector<double, 5>(243.4955, 377.3851, 394.2119, 397.8363, 405.3223);
  const Eigen::VectorXd published = Eigen::Vector<double, 5>(243.53, 377.41, 394.11, 397.72, 405.28);
  const Eigen::VectorXd ours = fv41_frequencies(4, 60, 5);
  CHECK((ours - converged).cwiseQuotient(converged).cwiseAbs().maxCoeff() < 2e-5);
  CHECK((ours - published).cwiseQuotient(published).cwiseAbs().maxCoeff() < 5e-4);
}

TEST_CASE("FV41: frequencies converge with order 4") {
  // A quadratic interpolation has energies, and so frequencies, of order 4. The first one comes soonest to its slope;
  // the others are at 3.9. The limit is extrapolated from the two finest meshes, which takes out their own error.
  const auto first = [](int columns) { return fv41_frequencies(columns, 40 * columns, 1)(0); };
  const std::vector<int> levels{2, 3, 4, 8};
  std::vector<double> frequency;
  for (const int columns : levels) frequency.push_back(first(columns));
  const double limit = frequency[3] - (frequency[2] - frequency[3]) / 15;
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
    const double slope =
        std::log((frequency[i] - limit) / (frequency[i + 1] - limit)) / std::log(double(levels[i + 1]) / levels[i]);
    CHECK(slope == about(4).epsilon(0.1 / 4));
  }
  CHECK(frequency[3] / limit - 1 > 1e-10);  // far above the rounding of a frequency, 1e-13
}

TEST_CASE("what cannot be a solid is refused") {
  AxisymmetricSolid solid = disc(CircleContact::punch, 0.2);
  CHECK_THROWS_WITH(axisymmetric_structure(solid),
                    "contact radius 0.2 m is larger than face A, whose radius is 0.1 m; use that or less");
  solid = disc(CircleContact::punch, 0.06);
  CHECK_THROWS_WITH(
      axisymmetric_structure(solid),
      "no node of the mesh lies on the circle of contact (radius 0.06 m; the last one inside is at 0.05 m); "
      "put one there or use that radius");
  solid = disc(CircleContact::punch, -1);
  CHECK_THROWS_WITH(axisymmetric_structure(solid), "contact radius -1 m is not positive");
  solid = disc(CircleContact::punch);
  solid.end_a = EndSupport::fixed;
  CHECK_THROWS_WITH(axisymmetric_structure(solid), "face A is held; a contact needs a free face");
  solid = disc(CircleContact::punch);
  solid.mesh.region[0] = 1;
  CHECK_THROWS_WITH(axisymmetric_structure(solid),
                    "the mesh has 2 regions, but there are 1 materials; give one for each");
  solid.materials.push_back(steel);
  CHECK_THROWS_WITH(axisymmetric_structure(solid),
                    "the circle of contact on face A straddles 2 materials; it must lie on one");
  solid = disc(CircleContact::punch);
  solid.mesh.elements.row(2).swap(solid.mesh.elements.row(3));
  std::swap(solid.mesh.elements(5, 1), solid.mesh.elements(5, 2));
  CHECK_THROWS_WITH(axisymmetric_structure(solid), doctest::Contains("element 6: a triangle is turned inside out"));
  solid = disc(CircleContact::punch);
  solid.mesh.nodes.col(0).array() += 0.01;
  CHECK_THROWS_WITH(axisymmetric_structure(solid),
                    "face A has no node on the axis, where a circle of contact has its middle");
  solid.mesh.elements(0, 0) = 10000;
  CHECK_THROWS_WITH(axisymmetric_structure(solid), "an element names a node that the mesh does not have");
}

}  // namespace
}  // namespace impulse
