#pragma once

#include "lib/material/laminate.hpp"

#include <Eigen/Dense>

namespace impulse {

/// Static answer of a thin, specially orthotropic rectangle 0 ≤ x ≤ a, 0 ≤ y ≤ b, simply supported (w = 0, moments 0),
/// to a unit force across it at (x₀, y₀).
struct PlateStatics {
  double deflection_m_per_N = 0;
  Eigen::Vector3d curvature_per_Nm;  ///< κ = (-w_xx, -w_yy, -2 w_xy) per N; the strain at height z is zκ
};

/// Lévy's series, Σ 2/a sin(mπx/a) sin(mπx₀/a) gₘ(y), with Green's function of Navier's operator along y,
///
///   gₘ = (γ₂ - γ₁) / (D₂₂ (k₁² - k₂²)),   γᵢ = sinh(kᵢ y<) sinh(kᵢ (b - y>)) / (kᵢ sinh kᵢb),
///   D₂₂ k⁴ - 2 (D₁₂ + 2 D₆₆) α² k² + D₁₁ α⁴ = 0,   α = mπ/a
///
/// (γᵢ is minus that of d²/dy² - kᵢ².) It converges like e^(-mπ|y - y₀|/a).
/// @throws std::invalid_argument if B, D₁₆ or D₂₆ is not zero, a point is outside, or y = y₀, where curvatures don't
/// converge. Verified by: tests/impulse/plate_statics.test.cpp
[[nodiscard]] PlateStatics simply_supported_plate_statics(const Laminate& laminate, double length_m, double width_m,
                                                          const Eigen::Vector2d& force, const Eigen::Vector2d& point);

}  // namespace impulse
