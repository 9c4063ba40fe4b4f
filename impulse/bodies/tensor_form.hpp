#pragma once

#include "impulse/bodies/plate_shape.hpp"
#include "impulse/bodies/ritz_basis.hpp"

#include <Eigen/Dense>

#include <vector>

namespace impulse {

/// Derivatives that strains are made of, in the order of the columns of an operator: f, f_x, f_y, f_xx, f_xy, f_yy.
constexpr Eigen::Index derivative_count = 6;
using DerivativeMatrix = Eigen::Matrix<double, derivative_count, derivative_count>;
using DerivativeRow = Eigen::Matrix<double, 1, derivative_count>;

/// Physical derivatives from those by (ξ, η): (f, f_x, ..., f_yy) = T (f, f_ξ, f_η, f_ξξ, f_ξη, f_ηη).
[[nodiscard]] DerivativeMatrix physical_derivatives(const PlateShape& shape, const Eigen::Vector2d& reference);

/// A field f = Σ aᵢⱼ bᵢ(ξ) bⱼ(η) and how it enters the strains (or velocities): ε += Eᶠ (f, f_x, ..., f_yy).
/// Coefficients are numbered i·n + j.
struct FormField {
  const RitzBasis* basis = nullptr;
  Eigen::Matrix<double, Eigen::Dynamic, derivative_count> operators;  ///< E, strains × derivatives
};

/// Values of a combination of derivatives of every function of a field at a point: `row`·(f, f_x, ..., f_yy).
[[nodiscard]] Eigen::VectorXd field_functional(const RitzBasis& basis, const PlateShape& shape,
                                               const Eigen::Vector2d& reference, const DerivativeRow& row);

/// Gauss points a side that integrate products of series of n terms over the shape to rounding: n for a
/// parallelogram; else more, since derivatives are divided by the Jacobian J. The rule's error falls like ρ^(-2·extra),
/// ρ = z + √(z² - 1), where J vanishes at the distance z = (J_max + J_min)/(J_max - J_min) from the middle.
[[nodiscard]] std::size_t quadrature_points(const PlateShape& shape, std::size_t terms);

/// The symmetric matrix of the form ∫ εᵀ W ε dA in the coefficients of the fields, one field after the other.
///
/// Sum factorisation: for each pair of fields and orders of η-derivatives the integrals along ξ are done first, as
/// products of (points × points) by (points × n²) matrices, then those along η as one of (n² × points) by (points ×
/// n²): 2 n⁴ Q operations a pair instead of n⁴ Q². Pairs that W does not couple cost nothing and are exactly zero.
/// Verified by: tests/impulse/tensor_form.test.cpp
[[nodiscard]] Eigen::MatrixXd tensor_form(const std::vector<FormField>& fields, const Eigen::MatrixXd& weight,
                                          const PlateShape& shape, std::size_t points);

}  // namespace impulse
