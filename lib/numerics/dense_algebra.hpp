#pragma once

#include <Eigen/Dense>

#include <optional>

namespace impulse {

/// C += Aᵀ B by BLAS (dgemm), for sizes where Eigen, compiled for any processor of the architecture, is five times
/// slower. @throws std::invalid_argument if the sizes do not fit.
void add_transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd& c);

/// A = LLᵀ of a symmetric positive definite matrix (its lower triangle is read), LAPACK dpotrf.
/// Verified by: tests/lib/dense_algebra.test.cpp
class DenseCholesky {
 public:
  /// Nothing if A is not positive definite to rounding. @throws std::invalid_argument if A is not square.
  [[nodiscard]] static std::optional<DenseCholesky> of(Eigen::MatrixXd a);

  [[nodiscard]] Eigen::MatrixXd solve(Eigen::MatrixXd b) const;

 private:
  explicit DenseCholesky(Eigen::MatrixXd lower) : lower_(std::move(lower)) {}
  Eigen::MatrixXd lower_;
};

/// Condition number (2-norm) of a symmetric positive definite matrix scaled to a unit diagonal: what a Cholesky
/// solution loses is this times ε. The scaling is within √n of the best there is [vanDerSluis1969].
/// @throws std::invalid_argument unless the diagonal is positive. Cost: 4/3 n³.
[[nodiscard]] double scaled_condition(const Eigen::MatrixXd& a);

}  // namespace impulse
