#pragma once

#include "impulse/bodies/ritz_plate.hpp"

#include <Eigen/Dense>

#include <vector>

namespace impulse {

/// Static flexibility [m/N] that a thin plate has under a point force beyond what its series of n terms a side has. The
/// deflection under the force is r² ln r, which a series approaches like k/(n - 2)²; so, from a coarser series m,
///
///   C - Cₙ = (Cₙ - Cₘ) (m - 2)² / ((n - 2)² - (m - 2)²),   m about ¾ n and of n's parity
///
/// for each of the points, given in (ξ, η). Leaves a fifth or less of the error of Cₙ (n ≥ 12). Zero for n < 8, and to
/// be asked of thin plates only: in shear theory there is no limit.
/// [Richardson1911]. Verified by: tests/impulse/point_flexibility.test.cpp
[[nodiscard]] Eigen::VectorXd missing_point_flexibility(const RitzPlate& plate,
                                                        const std::vector<Eigen::Vector2d>& points);

}  // namespace impulse
