#pragma once

#include "impulse/bodies/plate.hpp"
#include "impulse/bodies/tensor_form.hpp"

#include <Eigen/Dense>

#include <vector>

namespace impulse {

/// What a plate's displacements are made of: u, v and w of the middle surface, and the rotations φx, φy of its normal.
enum class PlateField { u, v, w, px, py };

/// How a field f enters strains or motions: += E (f, f_x, f_y, f_xx, f_xy, f_yy).
struct FieldOperator {
  PlateField field;
  Eigen::Matrix<double, Eigen::Dynamic, derivative_count> operators;  ///< E
};

/// Rows of the motions.
enum PlateMotionRow : Eigen::Index { motion_u, motion_v, motion_w, motion_px, motion_py, motion_count };

/// Strains of the fields that a plate has, in the order of PlateField. Rows, with c = -curvature:
///
///   0-2  ε = (u_x, v_y + c w, u_y + v_x)
///   3-5  κ = (φx_x, φy_y, φx_y + φy_x);  `thin`: φx = -w_x, φy = -w_y + c v
///   6-7  γ = (w_y + φy - c v, w_x + φx), `shear` only
///
/// u and v are left out unless moves_in_plane(plate), the rotations in `thin`.
/// Verified by: tests/impulse/ritz_plate.test.cpp
[[nodiscard]] std::vector<FieldOperator> strain_operators(const Plate& plate);

/// The same of the displacements and rotations, rows of PlateMotionRow.
[[nodiscard]] std::vector<FieldOperator> motion_operators(const Plate& plate);

/// Of the strains, per area: [A B; B D], with k S beside it in `shear`.
[[nodiscard]] Eigen::MatrixXd stiffness_weight(const Plate& plate);

/// Of the velocities, per area: I₀, I₁ and I₂; in `thin` I₀ alone.
[[nodiscard]] Eigen::MatrixXd mass_weight(const Plate& plate);

/// What acts at a point: resultants conjugate to the rows of strain_operators, forces to those of motion_operators.
struct PlateLoad {
  Eigen::Vector2d reference;  ///< (ξ, η)
  Eigen::VectorXd resultants;
  Eigen::VectorXd forces;
};

[[nodiscard]] PlateLoad no_load(const Plate& plate, const Eigen::Vector2d& reference);

/// Loads whose work is a motion, and a strain (0: εx, 1: εy, 2: γxy) at the height z.
[[nodiscard]] PlateLoad motion_load(const Plate& plate, const Eigen::Vector2d& reference, PlateMotionRow row);
[[nodiscard]] PlateLoad strain_load(const Plate& plate, const Eigen::Vector2d& reference, Eigen::Index strain,
                                    double z_m);

}  // namespace impulse
