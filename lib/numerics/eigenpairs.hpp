#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <cstddef>

namespace impulse {

/// Eigenvalues ascending, eigenvectors in columns with uᵀMu = 1.
struct Eigenpairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Lowest `count` eigenpairs of the symmetric tridiagonal matrix (diagonal, off_diagonal): LAPACK dstevr.
[[nodiscard]] Eigenpairs tridiagonal_eigenpairs(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& off_diagonal,
                                                std::size_t count);

/// Lowest `count` eigenpairs of K u = λ M u, both dense and symmetric, M positive definite: LAPACK dsygvx / dsygvd.
[[nodiscard]] Eigenpairs dense_eigenpairs(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m, std::size_t count);

/// The `count` eigenpairs of K u = λ M u nearest above `shift`: ARPACK in shift-invert mode with a sparse factorisation
/// of K - shift·M. @throws ConvergenceError if fewer converge.
[[nodiscard]] Eigenpairs shift_invert_eigenpairs(const Eigen::SparseMatrix<double>& k, const Eigen::SparseMatrix<double>& m,
                                                 std::size_t count, double shift);

}  // namespace impulse
