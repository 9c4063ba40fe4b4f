#pragma once

#include <Eigen/Dense>

#include <cstddef>

namespace impulse {

/// Points and weights of a quadrature rule on [-1, 1].
struct QuadratureRule {
  Eigen::VectorXd points;
  Eigen::VectorXd weights;
};

/// Gauss-Legendre rule (GSL glfixed): exact to rounding for polynomials of degree 2·count - 1.
/// @throws std::invalid_argument if count is 0. Verified by: tests/lib/quadrature.test.cpp
[[nodiscard]] QuadratureRule gauss_legendre(std::size_t count);

}  // namespace impulse
