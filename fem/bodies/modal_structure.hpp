#pragma once

#include "lib/model/modal_model.hpp"
#include "lib/model/structure.hpp"

namespace impulse {

/// A body by its modes, for explicit integration beside bodies of finite elements: the degrees of freedom are the modal
/// coordinates q,
///
///   q̈ + diag(2ζω) q̇ + diag(ω²) q = Φᵀ F,   contact displacement Φ q + R F,
///
/// Φ the participations and R the residual flexibility of the model. Modes with ω step_s > 1 are left to R, which gains
/// their φφᵀ/ω²: central differences would see them with a frequency more than 4 % too high, and beyond ω step_s = 2
/// not at all. Contact laws have R in series; a contact that is rigid is then the spring 1/R. The wave admittance is
/// kept where nothing was left out and R = 0; the translation is that of the rigid-body mode, if there is just one.
/// @throws std::invalid_argument for an invalid model, a step that is not positive, or if no mode is left.
/// Verified by: tests/fem/modal_structure.test.cpp
[[nodiscard]] Structure modal_structure(const ModalModel& body, double step_s);

}  // namespace impulse
