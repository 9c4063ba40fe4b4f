#pragma once

#include "fem/bodies/beam_structure.hpp"

namespace impulse {

/// The plane-stress part of beam_structure.hpp.
[[nodiscard]] Structure plane_stress_beam(const Beam& beam, const BeamModel& model, const BeamMesh& mesh);

/// The longest stable step of such a mesh with lumped mass, by its element.
[[nodiscard]] double plane_stress_beam_stable_step_s(const Beam& beam, const BeamModel& model, const BeamMesh& mesh);

}  // namespace impulse
