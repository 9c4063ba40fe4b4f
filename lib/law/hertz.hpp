#pragma once

#include "lib/material/material.hpp"

namespace impulse {

/// Contact modulus of an isotropic body, E/(1 - ν²) in Pa.
/// @throws std::invalid_argument if the material has no Poisson's ratio.
[[nodiscard]] double contact_modulus_Pa(const Material& material);

/// Stiffness k of Hertz' law F = k α^1.5 in N/m^1.5, for a spherical tip of radius R on a flat target:
///
///   k = (4/3) √R / [(1 - ν₁²)/E₁ + 1/E₂*]
///
/// with the tip's E₁ in Pa and ν₁, R in m, and the target's contact modulus E₂* in Pa: E₂/(1 - ν₂²) of an isotropic
/// body, the transverse modulus E₂ of the ply of a laminate [YangSun1982].
/// Limits: contact radius √(R α) small against R and the target's thickness; linear elastic, frictionless.
/// @throws std::invalid_argument if R or E₂* is not positive or the tip has no Poisson's ratio.
/// Reference: [Goldsmith1960] ch. 4. Verified by: tests/lib/hertz.test.cpp
[[nodiscard]] double hertz_stiffness(double tip_radius_m, const Material& tip, double target_modulus_Pa);

}  // namespace impulse
