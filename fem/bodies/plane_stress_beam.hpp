#pragma once

#include "fem/bodies/beam_structure.hpp"

namespace impulse {

/// @throws std::invalid_argument unless every patch lies on the beam.
void require_patches(const Beam& beam, double patch_length_m);

/// The plane-stress part of beam_structure.hpp.
[[nodiscard]] Structure plane_stress_beam(const Beam& beam, const BeamModel& model, const BeamMesh& mesh);

/// The longest stable step of such a mesh with lumped mass, by its element.
[[nodiscard]] double plane_stress_beam_stable_step_s(const Beam& beam, const BeamModel& model, const BeamMesh& mesh);

}  // namespace impulse
