#pragma once

#include "lib/model/modal_model.hpp"
#include "lib/series/uniform_series.hpp"

#include <Eigen/Dense>

namespace impulse {

/// Modal coordinates q of a body at rest under a force at one of its contacts, modes × samples [m kg^1/2]:
///
///   q̈ + 2ζω q̇ + ω² q = φ F(t),   F linear between samples: exact then, step by step
///
/// What an output o shows is oᵀΦ q + R_o F (ModalModel::output_participation and residual_outputs).
/// Cost: modes × samples.
/// @throws std::invalid_argument for an invalid model or a contact that it doesn't have.
/// Verified by: tests/impulse/modal_coordinates.test.cpp
[[nodiscard]] Eigen::MatrixXd modal_coordinates(const ModalModel& body, const UniformSeries& force,
                                                Eigen::Index contact = 0);

}  // namespace impulse
