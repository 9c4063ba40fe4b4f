#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <cstddef>
#include <limits>

namespace impulse {

/// Eigenvalues ascending, eigenvectors in columns with uᵀMu = 1. The same input gives the same bits: BLAS runs on one
/// thread (process-wide, from the first call on) and start vectors are fixed.
struct Eigenpairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
  std::size_t solve_count = 0;  ///< solutions with the factorised K - shift·M; 0 for the direct methods
};

/// Lowest `count` eigenpairs of the symmetric tridiagonal matrix (diagonal, off_diagonal): LAPACK dstevr for a
/// few, dstevd for a tenth and more.
/// Errors of the values are about ε times the largest eigenvalue, not the smallest. Cost: n·count², at most about n³
/// and by deflation mostly far less.
/// @throws std::invalid_argument if the sizes do not fit, count > n or a value is not finite.
/// Verified by: tests/lib/eigenpairs.test.cpp
[[nodiscard]] Eigenpairs tridiagonal_eigenpairs(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& off_diagonal,
                                                std::size_t count);

/// Lowest `count` eigenpairs of K u = λ M u, both dense and symmetric (the lower triangles are read), M positive
/// definite: LAPACK dsygvx for a few, dsygvd for many. Errors of the values as above. Cost: 10 n³.
/// @throws std::invalid_argument if the sizes do not fit, count > n, a value is not finite or M is not positive
/// definite. Verified by: tests/lib/eigenpairs.test.cpp
[[nodiscard]] Eigenpairs dense_eigenpairs(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m, std::size_t count);

/// Lowest eigenpairs of K u = λ M u, both dense and symmetric with both triangles stored, K + shift·M positive
/// definite: those with λ ≤ limit (to 1e-6 of it, a little more rather than less), at most `count`. As the largest μ of
/// M u = μ (K + shift·M) u: LAPACK dsytrd and, for a subset, dstemr. Low values are as accurate as the scaled condition
/// of K allows, whatever the largest one is: errors are about ε (λ + shift) times what cancels in uᵀKu. High ones,
/// where that is no longer so, are Rayleigh quotients. Cost: 8/3 n³ and 4 n² for each pair.
/// @throws std::invalid_argument if the sizes do not fit, a value is not finite or K + shift·M is not positive
/// definite. Verified by: tests/lib/eigenpairs.test.cpp
[[nodiscard]] Eigenpairs lowest_dense_eigenpairs(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m, double shift,
                                                 std::size_t count,
                                                 double limit = std::numeric_limits<double>::infinity());

/// The `count` eigenpairs of K u = λ M u nearest above `shift`: ARPACK in shift-invert mode with a sparse factorisation
/// of K - shift·M. K and M are symmetric with both triangles stored, M is positive definite. No eigenvalue is missed,
/// multiple ones included: the number found is checked by the inertia of K - xM, and what is missing is sought again
/// orthogonally to what was found. `shift` must not be an eigenvalue, and lie no further below the values wanted than
/// their own magnitude, or the values lose as many digits.
/// Cost: a factorisation each at the shift and for the check, then solve_count solutions and about 50 n·count²
/// operations.
/// @throws std::invalid_argument if the sizes do not fit or not count < n; ConvergenceError if fewer converge or the
/// inertia contradicts.
/// Verified by: tests/lib/eigenpairs.test.cpp
[[nodiscard]] Eigenpairs shift_invert_eigenpairs(const Eigen::SparseMatrix<double>& k,
                                                 const Eigen::SparseMatrix<double>& m, std::size_t count, double shift);

/// Number of eigenvalues of K u = λ M u below x: negative pivots of K - xM = LDLᵀ (Sylvester's law of inertia). Where x
/// hits an eigenvalue to within rounding (1e-12 of x; 1e-6 where a pivot vanishes), that one may be counted or not.
/// @throws ConvergenceError if no stable factorisation is found near x.
/// Verified by: tests/lib/eigenpairs.test.cpp
[[nodiscard]] std::size_t eigenvalue_count_below(const Eigen::SparseMatrix<double>& k,
                                                 const Eigen::SparseMatrix<double>& m, double x);

}  // namespace impulse
