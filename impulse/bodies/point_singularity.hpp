#pragma once

#include "impulse/bodies/tensor_form.hpp"
#include "lib/material/laminate.hpp"

#include <Eigen/Dense>

#include <vector>

namespace impulse {

/// Static displacements of an infinite thin laminate, flat, under a unit force across it at the origin [m/N], up to a
/// motion without strain or with even strain, as plane waves over all directions e = (cos θ, sin θ):
///
///   w = 1/(8π²) ∮ ψ(x·e) / L dθ,   (u, v) = 1/(8π²) ∮ a⁻¹b ψ'(x·e) / L dθ,   ψ(t) = t² ln|t|
///   L = pᵀDp - bᵀa⁻¹b,   a = PᵀAP,   b = PᵀBp,   P = [e₁ 0; 0 e₂; e₂ e₁],   p = Pe
///
/// In an isotropic plate w = r² ln r / 8πD. The curvature is singular like ln r whatever the laminate.
/// The rest of a plate's answer, and what a small curvature of the panel adds, is smoother.
/// Verified by: tests/impulse/point_singularity.test.cpp
class PointSingularity {
 public:
  explicit PointSingularity(const Laminate& laminate);

  /// Rows u, v, w; columns f, f_x, f_y, f_xx, f_xy, f_yy, the second derivatives of w alone (u and v: 0).
  /// @throws std::invalid_argument at the origin.
  [[nodiscard]] Eigen::Matrix<double, 3, derivative_count> at(const Eigen::Vector2d& offset_m) const;

 private:
  struct Wave {
    Eigen::Vector2d direction;
    double w;
    Eigen::Vector2d in_plane;
  };
  std::vector<Wave> waves_;
};

}  // namespace impulse
