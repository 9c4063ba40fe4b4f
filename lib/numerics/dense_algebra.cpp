#include "lib/numerics/dense_algebra.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/numerics/single_thread_blas.hpp"

#include <lapacke.h>

// Declared here because <cblas.h> may be another BLAS's.
extern "C" void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*,
                       const int*, const double*, const int*, const double*, double*, const int*);

namespace impulse {

void add_transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd& c) {
  require(a.rows() == b.rows() && c.rows() == a.cols() && c.cols() == b.cols(),
          "({} x {})ᵀ times {} x {} is not {} x {}", a.rows(), a.cols(), b.rows(), b.cols(), c.rows(), c.cols());
  use_one_blas_thread();
  const auto m = static_cast<int>(a.cols()), n = static_cast<int>(b.cols()), k = static_cast<int>(a.rows());
  const double one = 1;
  if (m > 0 && n > 0 && k > 0) dgemm_("T", "N", &m, &n, &k, &one, a.data(), &k, b.data(), &k, &one, c.data(), &m);
}

std::optional<DenseCholesky> DenseCholesky::of(Eigen::MatrixXd a) {
  require(a.rows() == a.cols(), "a matrix {} x {} has no Cholesky factor", a.rows(), a.cols());
  use_one_blas_thread();
  const auto n = static_cast<lapack_int>(a.rows());
  const lapack_int info = LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', n, a.data(), n);
  if (info != 0) return std::nullopt;
  return DenseCholesky(std::move(a));
}

Eigen::MatrixXd DenseCholesky::solve(Eigen::MatrixXd b) const {
  require(b.rows() == lower_.rows(), "{} rows do not fit {} unknowns", b.rows(), lower_.rows());
  const auto n = static_cast<lapack_int>(lower_.rows());
  if (b.cols() > 0)
    LAPACKE_dpotrs(LAPACK_COL_MAJOR, 'L', n, static_cast<lapack_int>(b.cols()), lower_.data(), n, b.data(), n);
  return b;
}

double scaled_condition(const Eigen::MatrixXd& a) {
  require(a.rows() == a.cols() && (a.diagonal().array() > 0).all(),
          "a matrix {} x {} without a positive diagonal has no scaled condition number", a.rows(), a.cols());
  use_one_blas_thread();
  const Eigen::VectorXd scale = a.diagonal().cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd scaled = scale.asDiagonal() * a * scale.asDiagonal();
  Eigen::VectorXd values(a.rows());
  const auto n = static_cast<lapack_int>(a.rows());
  if (LAPACKE_dsyev(LAPACK_COL_MAJOR, 'N', 'L', n, scaled.data(), n, values.data()) != 0)
    throw ConvergenceError("the eigenvalues of a scaled matrix do not converge", 0, 0, 0);
  return values(0) > 0 ? values(n - 1) / values(0) : std::numeric_limits<double>::infinity();
}

}  // namespace impulse
