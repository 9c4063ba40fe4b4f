#pragma once

#include "impulse/exact/mode_range.hpp"
#include "lib/material/profile.hpp"
#include "lib/model/modal_model.hpp"

namespace impulse {

/// Exact modes of a bar of cylinders and cones (one-dimensional theory).
///
/// In each segment ψ = D·u obeys ψ'' + (ω/c)²ψ = 0, so ψ = R sin θ with θ' = ω/c. The Prüfer angle tan Θ = Zω·u/N,
/// continuous along the chain, grows with ω where it meets the far end's condition, so mode n is the only root of
/// Θ_end(ω) = Θ_n + nπ: none is missed and none counted twice, however unlike the segments are. Modal mass in closed
/// form, ∫ρA u² dy = ρ(π/4)∫ψ² dy. Participation is u into the body at each face over √(modal mass); a free bar's
/// rigid-body mode has ω = 0 and 1/√m exactly. Cost: about ten passes along the chain a mode.
/// @throws std::invalid_argument for an infinite far end, which has no modes, and for a range without an end.
/// Verified by: tests/impulse/bar_modes.test.cpp
[[nodiscard]] ModalModel exact_bar_modes(const Bar& bar, const ModeRange& range);

}  // namespace impulse
