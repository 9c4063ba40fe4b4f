#pragma once

#include "impulse/response/response.hpp"

#include <Eigen/Dense>

#include <vector>

namespace impulse {

/// The response whose displacements under unit step forces are known on the grid, pair by pair (row i moves, column j
/// is struck). H is the mean of the neighbouring steps' ΔU/Δt, its row 0 the given H(0+) (p × p); G the same of H.
/// Order 2 where U is smooth; what solvers take, U, is untouched.
/// @throws std::invalid_argument if sizes disagree, there are fewer than three samples, or a value is not finite.
/// Verified by: tests/impulse/displacement_response.test.cpp
[[nodiscard]] Response displacement_response(const UniformGrid& grid,
                                             const std::vector<std::vector<double>>& step_displacement,
                                             const Eigen::MatrixXd& wave_admittance);

}  // namespace impulse
