#pragma once

#include "impulse/response/response.hpp"
#include "lib/model/modal_model.hpp"

namespace impulse {

/// Response of a body by modal superposition, with ω_d = ω√(1-ζ²), s = ζω and p = φᵢφⱼ per mode:
///
///   G = Σ p e^(-st) [cos ω_d t - (s/ω_d) sin ω_d t]
///   H = Σ (p/ω_d) e^(-st) sin ω_d t
///   U = R + Σ (p/ω²) [1 - e^(-st)(cos ω_d t + (s/ω_d) sin ω_d t)]
///
/// A rigid-body mode (ω = 0) adds p, p t and p t²/2. At t = 0, H is the body's wave admittance H(0+) where it has one:
/// the sum itself starts from 0 and reaches it within half a period of the highest mode.
/// For a rod G tends to Dirac pulses and does not converge pointwise: integrate it, do not read it.
/// Cost: sample_count × mode_count; error about 1e-13 of Σ|p| (the rotations are restarted every 1024 samples).
/// @throws std::invalid_argument for an invalid model. Verified by: tests/impulse/modal_response.test.cpp
[[nodiscard]] Response modal_response(const ModalModel& body, const UniformGrid& grid);

}  // namespace impulse
