#include "fem/bodies/plane_stress_beam.hpp"

#include "fem/bodies/plane_stress_structure.hpp"
#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {
namespace {

QuadrilateralCorners rectangle(double length, double height) {
  QuadrilateralCorners corners;
  corners << 0, 0, length, 0, length, height, 0, height;
  return corners;
}

void hold_section(std::vector<Eigen::Index>& held, const MappedMesh& mesh, std::size_t i, bool along_too) {
  for (std::size_t j = 0; j <= mesh.across; ++j) {
    if (along_too) held.push_back(2 * mesh.node(i, j));
    held.push_back(2 * mesh.node(i, j) + 1);
  }
}

std::vector<Eigen::Index> held_dofs(BeamSupports supports, const MappedMesh& mesh) {
  std::vector<Eigen::Index> held;
  const bool clamped = supports != BeamSupports::simple;
  if (supports == BeamSupports::free) return held;
  hold_section(held, mesh, 0, clamped);
  if (supports != BeamSupports::cantilever) hold_section(held, mesh, mesh.along, clamped);
  // Against sliding: where a load in the middle of the span does not try to move the beam along.
  if (!clamped) held.push_back(2 * mesh.node(mesh.along / 2, mesh.across / 2));
  return held;
}

/// ∫ of the hat function of node i over [from, to], in element lengths.
double hat_integral(std::size_t i, std::size_t last, double from, double to) {
  const double centre = static_cast<double>(i);
  // ∫ up to x of the hat that rises from centre-1 and falls to centre+1.
  const auto upto = [centre](double x) {
    const double t = std::clamp(x - centre, -1.0, 1.0);
    return t < 0 ? 0.5 * (1 + t) * (1 + t) : 1 - 0.5 * (1 - t) * (1 - t);
  };
  return upto(std::min(to, static_cast<double>(last))) - upto(std::max(from, 0.0));
}

/// Mean downward displacement of each patch of the top face.
Eigen::MatrixXd patch_means(const Beam& beam, double patch, const MappedMesh& mesh) {
  Eigen::MatrixXd means =
      Eigen::MatrixXd::Zero(2 * mesh.node_count(), static_cast<Eigen::Index>(beam.contacts_at.size()));
  for (std::size_t c = 0; c < beam.contacts_at.size(); ++c) {
    const double per_element = static_cast<double>(mesh.along) / beam.length_m;
    const double from = beam.contacts_at[c] * static_cast<double>(mesh.along) - 0.5 * patch * per_element;
    const double to = from + patch * per_element;
    for (std::size_t i = 0; i <= mesh.along; ++i)
      means(2 * mesh.node(i, mesh.across) + 1, static_cast<Eigen::Index>(c)) =
          -hat_integral(i, mesh.along, from, to) / (to - from);
  }
  return means;
}

}  // namespace

void require_patches(const Beam& beam, double patch) {
  require(std::isfinite(patch) && patch > 0,
          "plane stress needs a patch to press on (under a line of force the displacement has no limit); give its "
          "length, 1mm for instance");
  for (const double at : beam.contacts_at)
    require(at * beam.length_m - patch / 2 >= -1e-12 * beam.length_m &&
                at * beam.length_m + patch / 2 <= beam.length_m * (1 + 1e-12),
            "the patch of {:g} m about {:g} of the length reaches beyond the beam's end; use a shorter patch", patch,
            at);
}

Structure plane_stress_beam(const Beam& beam, const BeamModel& model, const BeamMesh& mesh) {
  require_patches(beam, model.patch_length_m);
  require(mesh.through > 0, "plane stress needs elements through the height");
  require(beam.supports != BeamSupports::simple || (mesh.along % 2 == 0 && mesh.through % 2 == 0),
          "{} x {} elements have no node in the middle, which simple supports hold along the beam; use even numbers",
          mesh.along, mesh.through);
  const MappedMesh mapped{rectangle(beam.length_m, beam.height_m), mesh.along, mesh.through};
  Structure body = plane_stress_structure({.mesh = mapped,
                                           .material = beam.material,
                                           .thickness_m = beam.width_m,
                                           .element = model.quadrilateral,
                                           .mass = mesh.mass,
                                           .held = held_dofs(beam.supports, mapped)},
                                          patch_means(beam, model.patch_length_m, mapped));
  const double nu = *beam.material.poissons_ratio;
  const double impedance =
      std::sqrt(beam.material.youngs_modulus_Pa * beam.material.density_kg_per_m3 / (1 - nu * nu)) *
      model.patch_length_m * beam.width_m;
  body.wave_admittance.diagonal().setConstant(1 / impedance);
  return body;
}

double plane_stress_beam_stable_step_s(const Beam& beam, const BeamModel& model, const BeamMesh& mesh) {
  const QuadrilateralCorners element =
      rectangle(beam.length_m / static_cast<double>(mesh.along), beam.height_m / static_cast<double>(mesh.through));
  return 2 / plane_stress_highest_frequency(element, beam.material, model.quadrilateral);
}

}  // namespace impulse
