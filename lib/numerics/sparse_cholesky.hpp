#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <functional>
#include <memory>
#include <optional>

namespace impulse {

/// A = LLᵀ of a sparse symmetric positive definite matrix, both triangles stored, by CHOLMOD: supernodes, that is,
/// dense blocks in BLAS on one thread. Beside Eigen's column by column: solutions of many right-hand sides together 5
/// times faster, of one 2 times, factorisations of some 10⁴ unknowns 4 times; none is slower from some 10² unknowns on.
/// Verified by: tests/lib/sparse_cholesky.test.cpp
class SparseCholesky {
 public:
  /// Nothing if A is not positive definite to rounding. @throws std::invalid_argument if A is not square.
  [[nodiscard]] static std::optional<SparseCholesky> of(const Eigen::SparseMatrix<double>& a);

  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;
  ~SparseCholesky();

  /// A⁻¹b; of a matrix column by column. @throws std::invalid_argument if the rows do not fit.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  struct Factor;
  explicit SparseCholesky(std::unique_ptr<Factor> factor);
  std::unique_ptr<Factor> factor_;
};

/// A⁻¹b, if it solves Ax = b to 10⁻⁶ of b: a stiffness that leaves a rigid motion free may factorise by rounding, but
/// has no answer to a load that works in that motion. Verified by: tests/lib/sparse_cholesky.test.cpp
[[nodiscard]] std::optional<Eigen::VectorXd> answer_of_held(const SparseCholesky& factor,
                                                            const Eigen::SparseMatrix<double>& a,
                                                            const Eigen::VectorXd& b);

using LinearSolver = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// b → A⁻¹b for a symmetric A, factorised once: SparseCholesky, or LDLᵀ without pivoting where A is indefinite, as a
/// tangent stiffness beyond a limit point is; empty if that breaks down too.
[[nodiscard]] LinearSolver symmetric_solver(const Eigen::SparseMatrix<double>& a);

}  // namespace impulse
