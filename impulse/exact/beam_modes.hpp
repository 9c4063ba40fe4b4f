#pragma once

#include "impulse/exact/mode_range.hpp"
#include "lib/material/beam.hpp"
#include "lib/model/modal_model.hpp"

namespace impulse {

/// Exact modes of a uniform beam (Euler-Bernoulli theory: no shear, no rotary inertia), ω = β²√(EI/(ρA))/L², and the
/// residual flexibility of those left out, R = static influence function - Σ φᵢφⱼ/ω² (beam_statics.hpp), 0 where that
/// is rounding. Participation φ/√(ρAL) with ∫φ² dξ = 1, s = ξ - ½:
///
///   simple      β = nπ                      φ = √2 sin βξ
///   clamped     cos β cosh β = 1            φ = g(s) - k(s),  g = cos βs/cos ½β, k = cosh βs/cosh ½β (n odd)
///   free        the same β, rigid 1, √12 s  φ = g(s) + k(s),  or with sine and sinh (n even)
///   cantilever  cos β cosh β = -1           φ = -cos βξ + σ sin βξ + ½(1+σ)e^(-βξ) + ½(1-σ)e^(βξ),
///                                           σ = (sinh β - sin β)/(cosh β + cos β)
///
/// No mode cancels: k is taken as [e^-β(½-s) ± e^-β(½+s)]/(1 ± e^-β), and (1-σ)e^(βξ)/2 as
/// (cos β + sin β + e^-β)e^-β(1-ξ)/(1 + 2e^-β cos β + e^-2β), so that φ is right to about βε however high the mode.
/// The wave admittance is 0: a beam that does not shear begins to move gradually (H ∝ √t).
/// Cost: some twenty cosines a mode.
/// @throws std::invalid_argument for an invalid beam and for a range without an end, above 1e6 modes or short of the
/// two rigid-body modes of a free beam. Reference: [Blevins1979] ch. 8. Verified by: tests/impulse/beam_modes.test.cpp
[[nodiscard]] ModalModel exact_beam_modes(const Beam& beam, const ModeRange& range);

}  // namespace impulse
