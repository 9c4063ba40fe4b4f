#include "fem/bodies/beam_structure.hpp"

#include "fem/bodies/assembly.hpp"
#include "fem/bodies/plane_stress_beam.hpp"
#include "fem/elements/hermite_beam.hpp"
#include "lib/contract/require.hpp"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cmath>

namespace impulse {
namespace {

/// Beyond, rounding spoils the low modes: the highest eigenvalue over the lowest grows as the fourth power.
constexpr std::size_t most_elements = 2000;

std::size_t even_near(double value) { return 2 * static_cast<std::size_t>(std::max(1.0, std::round(value / 2))); }

double hermite_stable_step_s(const Beam& beam, std::size_t along) {
  const double n = static_cast<double>(along);
  return 2 / (std::sqrt(48.0) * n * n * beam.slenderness_frequency());
}

double stable_step_s(const Beam& beam, const BeamModel& model, const BeamMesh& mesh) {
  return model.element == BeamElement::hermite ? hermite_stable_step_s(beam, mesh.along)
                                               : plane_stress_beam_stable_step_s(beam, model, mesh);
}

void require_mesh(const BeamMesh& mesh) {
  require(mesh.along >= 2, "{} element along the beam is too few; use at least 2", mesh.along);
  require(mesh.along <= most_elements,
          "{} elements along the beam lose its low modes to rounding (more than {}); use fewer", mesh.along,
          most_elements);
}

std::vector<Eigen::Index> held_dofs(BeamSupports supports, std::size_t along) {
  const Eigen::Index last = 2 * static_cast<Eigen::Index>(along);
  switch (supports) {
    case BeamSupports::simple:
      return {0, last};
    case BeamSupports::clamped:
      return {0, 1, last, last + 1};
    case BeamSupports::cantilever:
      return {0, 1};
    default:
      return {};
  }
}

/// Deflection at each contact as a functional of all nodes' (w, θ).
Eigen::MatrixXd deflections(const Beam& beam, std::size_t along) {
  const double n = static_cast<double>(along);
  Eigen::MatrixXd functionals = Eigen::MatrixXd::Zero(2 * static_cast<Eigen::Index>(along) + 2,
                                                      static_cast<Eigen::Index>(beam.contacts_at.size()));
  for (std::size_t c = 0; c < beam.contacts_at.size(); ++c) {
    const double place = beam.contacts_at[c] * n;
    const double element = std::min(std::floor(place), n - 1);
    functionals.block<4, 1>(2 * static_cast<Eigen::Index>(element), static_cast<Eigen::Index>(c)) =
        hermite_beam_shape(place - element, beam.length_m / n);
  }
  return functionals;
}

struct HermiteBeam {
  Eigen::SparseMatrix<double> stiffness;
  Eigen::SparseMatrix<double> mass;
  Eigen::MatrixXd contacts;
};

/// With every degree of freedom that is not held, and consistent mass.
HermiteBeam whole_beam(const Beam& beam, std::size_t along, const FreeDofs& dofs) {
  const double h = beam.length_m / static_cast<double>(along);
  const Eigen::Matrix4d k = hermite_beam_stiffness(beam.bending_stiffness_Nm2(), h);
  const Eigen::Matrix4d m = hermite_beam_consistent_mass(beam.mass_kg() / beam.length_m, h);
  MatrixAssembly stiffness(dofs), mass(dofs);
  for (Eigen::Index e = 0; e < static_cast<Eigen::Index>(along); ++e) {
    const std::array<Eigen::Index, 4> places{2 * e, 2 * e + 1, 2 * e + 2, 2 * e + 3};
    stiffness.add(places, k);
    mass.add(places, m);
  }
  const Eigen::MatrixXd all = deflections(beam, along);
  Eigen::MatrixXd contacts = Eigen::MatrixXd::Zero(dofs.count(), all.cols());
  for (Eigen::Index dof = 0; dof < all.rows(); ++dof)
    if (dofs[dof] != FreeDofs::held) contacts.row(dofs[dof]) = all.row(dof);
  return {stiffness.matrix(), mass.matrix(), contacts};
}

/// Rows of the identity that pick the free degrees of freedom of one kind: 0 deflections, 1 rotations.
Eigen::SparseMatrix<double> picked(const FreeDofs& dofs, std::size_t along, Eigen::Index kind) {
  std::vector<Eigen::Triplet<double>> ones;
  Eigen::Index count = 0;
  for (Eigen::Index node = 0; node <= static_cast<Eigen::Index>(along); ++node)
    if (dofs[2 * node + kind] != FreeDofs::held) ones.emplace_back(count++, dofs[2 * node + kind], 1.0);
  Eigen::SparseMatrix<double> rows(count, dofs.count());
  rows.setFromTriplets(ones.begin(), ones.end());
  return rows;
}

/// Nodal masses in element masses: the trapezoidal rule, which is of order 4 where the deflection is held, and at free
/// ends Gregory's correction, without which they would spoil the order to 2.
Eigen::VectorXd mass_weights(BeamSupports supports, std::size_t along) {
  const Eigen::Index last = static_cast<Eigen::Index>(along);
  const double end = -1.0 / 2, gregory[] = {-1.0 / 8, 1.0 / 6, -1.0 / 24};
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(last + 1);
  weights(0) += end;
  weights(last) += end;
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (supports == BeamSupports::free) weights(i) += gregory[i];
    if (supports == BeamSupports::free || supports == BeamSupports::cantilever) weights(last - i) += gregory[i];
  }
  return weights;
}

/// The deflections alone, rotations condensed: K_ww - K_wθ K_θθ⁻¹ K_θw, and the contacts with it.
HermiteBeam spline_beam(const Beam& beam, std::size_t along, const FreeDofs& dofs) {
  const HermiteBeam whole = whole_beam(beam, along, dofs);
  const Eigen::SparseMatrix<double> w = picked(dofs, along, 0), theta = picked(dofs, along, 1);
  const Eigen::SparseMatrix<double> rotation_stiffness = theta * whole.stiffness * theta.transpose();
  const Eigen::SparseMatrix<double> coupling = theta * whole.stiffness * w.transpose();
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factorised(rotation_stiffness);
  const Eigen::MatrixXd followed = factorised.solve(Eigen::MatrixXd(coupling));  // rotations are -followed·w
  Eigen::MatrixXd k = Eigen::MatrixXd(w * whole.stiffness * w.transpose()) - coupling.transpose() * followed;
  k = (k + k.transpose()).eval() / 2;

  HermiteBeam spline;
  // The spline's influence falls by 2 - √3 from node to node, below rounding after some thirty.
  spline.stiffness = k.sparseView(k.diagonal().maxCoeff(), 1e-18);
  spline.contacts = w * whole.contacts - followed.transpose() * (theta * whole.contacts);
  const Eigen::VectorXd weights = mass_weights(beam.supports, along);
  std::vector<Eigen::Triplet<double>> masses;
  for (Eigen::Index node = 0; node < weights.size(); ++node)
    if (dofs[2 * node] != FreeDofs::held) {
      const auto row = static_cast<Eigen::Index>(masses.size());
      masses.emplace_back(row, row, weights(node) * beam.mass_kg() / static_cast<double>(along));
    }
  spline.mass.resize(k.rows(), k.rows());
  spline.mass.setFromTriplets(masses.begin(), masses.end());
  return spline;
}

Structure hermite_beam(const Beam& beam, const BeamMesh& mesh) {
  const FreeDofs dofs(2 * static_cast<Eigen::Index>(mesh.along) + 2, held_dofs(beam.supports, mesh.along));
  HermiteBeam matrices =
      mesh.mass == MassMatrix::consistent ? whole_beam(beam, mesh.along, dofs) : spline_beam(beam, mesh.along, dofs);
  const Eigen::Index contact_count = matrices.contacts.cols();
  Structure body;
  body.stiffness = std::move(matrices.stiffness);
  body.mass = std::move(matrices.mass);
  body.contacts = std::move(matrices.contacts);
  body.outputs = Eigen::MatrixXd::Zero(body.mass.rows(), 0);
  body.wave_admittance = Eigen::MatrixXd::Zero(contact_count, contact_count);
  return body;
}

}  // namespace

BeamMesh beam_mesh_by_count(const Beam& beam, const BeamModel& model, std::size_t along, MassMatrix mass) {
  require_valid(beam);
  BeamMesh mesh{along, 1, mass};
  require_mesh(mesh);
  if (model.element == BeamElement::plane_stress)
    mesh.through = even_near(static_cast<double>(along) * beam.height_m / beam.length_m);
  return mesh;
}

BeamMesh beam_mesh_by_step(const Beam& beam, const BeamModel& model, double step_s) {
  require_valid(beam);
  require(std::isfinite(step_s) && step_s > 0, "step {} s is not positive", step_s);
  const auto mesh_of = [&](std::size_t along) { return beam_mesh_by_count(beam, model, along, MassMatrix::lumped); };
  const double forgiving_step = step_s / (1 + 1e-12);
  const double longest = stable_step_s(beam, model, mesh_of(2));
  require(longest >= forgiving_step,
          "step {:.4g} us is too long for a beam of two elements (stable up to {:.4g} us); use a step of {:.3g} us or "
          "less",
          step_s * 1e6, longest * 1e6, 0.999 * longest * 1e6);
  std::size_t stable = 2, unstable = most_elements + 2;
  require(stable_step_s(beam, model, mesh_of(most_elements)) < forgiving_step,
          "step {:.4g} s is stable for more than {} elements along the beam; use a longer step", step_s, most_elements);
  // Even numbers, which simple supports of plane stress need and which put a node under the middle.
  while (unstable - stable > 2) {
    const std::size_t middle = (stable + unstable) / 4 * 2;
    (stable_step_s(beam, model, mesh_of(middle)) >= forgiving_step ? stable : unstable) = middle;
  }
  return mesh_of(stable);
}

Structure beam_structure(const Beam& beam, const BeamModel& model, const BeamMesh& mesh) {
  require_valid(beam);
  require_mesh(mesh);
  return model.element == BeamElement::hermite ? hermite_beam(beam, mesh) : plane_stress_beam(beam, model, mesh);
}

}  // namespace impulse
