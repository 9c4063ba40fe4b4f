#include "fem/bodies/plane_stress_structure.hpp"

#include "fem/bodies/assembly.hpp"
#include "lib/contract/require.hpp"

#include <array>
#include <cmath>

namespace impulse {
namespace {

void require_sheet(const Sheet& sheet, const Eigen::MatrixXd& functionals) {
  const MappedMesh& mesh = sheet.mesh;
  require(mesh.along > 0 && mesh.across > 0, "a mesh of {} x {} elements has none", mesh.along, mesh.across);
  require(static_cast<double>(mesh.along) * static_cast<double>(mesh.across) <= 1e6,
          "{} x {} elements are more than can be had (1e6); use fewer", mesh.along, mesh.across);
  require(std::isfinite(sheet.thickness_m) && sheet.thickness_m > 0, "thickness {} m is not positive",
          sheet.thickness_m);
  require(std::isfinite(sheet.material.density_kg_per_m3) && sheet.material.density_kg_per_m3 > 0,
          "density {} kg/m3 is not positive", sheet.material.density_kg_per_m3);
  require(functionals.rows() == 2 * mesh.node_count(), "functionals of {} rows for {} degrees of freedom",
          functionals.rows(), 2 * mesh.node_count());
}

QuadrilateralMatrix element_mass(const Sheet& sheet, const QuadrilateralCorners& corners) {
  const double density = sheet.material.density_kg_per_m3;
  if (sheet.mass == MassMatrix::consistent) return plane_stress_consistent_mass(corners, density, sheet.thickness_m);
  const Eigen::Vector4d nodal = plane_stress_lumped_mass(corners, density, sheet.thickness_m);
  QuadrilateralMatrix mass = QuadrilateralMatrix::Zero();
  for (Eigen::Index i = 0; i < 8; ++i) mass(i, i) = nodal(i / 2);
  return mass;
}

}  // namespace

Eigen::RowVector2d MappedMesh::position(std::size_t i, std::size_t j) const {
  const double xi = static_cast<double>(i) / static_cast<double>(along);
  const double eta = static_cast<double>(j) / static_cast<double>(across);
  return Eigen::RowVector4d{(1 - xi) * (1 - eta), xi * (1 - eta), xi * eta, (1 - xi) * eta} * corners;
}

Structure plane_stress_structure(const Sheet& sheet, const Eigen::MatrixXd& functionals) {
  require_sheet(sheet, functionals);
  const MappedMesh& mesh = sheet.mesh;
  const FreeDofs dofs(2 * mesh.node_count(), sheet.held);
  MatrixAssembly stiffness(dofs), mass(dofs);
  for (std::size_t i = 0; i < mesh.along; ++i)
    for (std::size_t j = 0; j < mesh.across; ++j) {
      const std::array<std::array<std::size_t, 2>, 4> corner{{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
      QuadrilateralCorners corners;
      std::array<Eigen::Index, 8> element_dofs{};
      for (std::size_t c = 0; c < 4; ++c) {
        corners.row(static_cast<Eigen::Index>(c)) = mesh.position(corner[c][0], corner[c][1]);
        const Eigen::Index node = mesh.node(corner[c][0], corner[c][1]);
        element_dofs[2 * c] = 2 * node;
        element_dofs[2 * c + 1] = 2 * node + 1;
      }
      stiffness.add(element_dofs, plane_stress_stiffness(corners, sheet.material, sheet.thickness_m, sheet.element));
      mass.add(element_dofs, element_mass(sheet, corners));
    }
  const Eigen::Index contact_count = functionals.cols();
  Structure body;
  body.stiffness = stiffness.matrix();
  body.mass = mass.matrix();
  body.contacts = Eigen::MatrixXd::Zero(dofs.count(), contact_count);
  for (Eigen::Index dof = 0; dof < functionals.rows(); ++dof)
    if (dofs[dof] != FreeDofs::held) body.contacts.row(dofs[dof]) = functionals.row(dof);
  body.outputs = Eigen::MatrixXd::Zero(dofs.count(), 0);
  body.wave_admittance = Eigen::MatrixXd::Zero(contact_count, contact_count);
  return body;
}

}  // namespace impulse
