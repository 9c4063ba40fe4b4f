#include "lib/numerics/eigenpairs.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/numerics/single_thread_blas.hpp"

#include <lapacke.h>

namespace impulse {
namespace {

/// LAPACK's int counts matrix elements in places, so n² must stay within it.
constexpr Eigen::Index largest_dense_size = 40000;

void require_count(std::size_t count, Eigen::Index n) {
  require(count <= static_cast<std::size_t>(n), "{} eigenpairs asked of a matrix of size {}; ask for at most {}", count,
          n, n);
}

void require_lapack(lapack_int info, const char* routine) {
  if (info == LAPACK_WORK_MEMORY_ERROR || info == LAPACK_TRANSPOSE_MEMORY_ERROR) throw std::bad_alloc();
  require(info >= 0, "{} refuses its argument {}", routine, -info);
  if (info > 0)
    throw ConvergenceError(fmt::format("{} does not converge (info = {}); scale the matrix", routine, info), 0, 0, 0);
}

Eigenpairs first(Eigenpairs pairs, Eigen::Index count) {
  pairs.values.conservativeResize(count);
  pairs.vectors.conservativeResize(Eigen::NoChange, count);
  return pairs;
}

/// Positive info of dsygv*: beyond n, a leading minor of M is not positive.
void require_definite(lapack_int info, lapack_int n) {
  require(info <= n,
          "the mass matrix is not positive definite (its leading minor {} is not); give every degree of freedom mass",
          info - n);
}

Eigenpairs all_dense(Eigen::MatrixXd k, Eigen::MatrixXd m) {
  const auto n = static_cast<lapack_int>(k.rows());
  Eigen::VectorXd values(n);
  const lapack_int info = LAPACKE_dsygvd(LAPACK_COL_MAJOR, 1, 'V', 'L', n, k.data(), n, m.data(), n, values.data());
  require_definite(info, n);
  require_lapack(info, "dsygvd");
  return {values, std::move(k)};
}

Eigenpairs lowest_dense(Eigen::MatrixXd k, Eigen::MatrixXd m, lapack_int count) {
  const auto n = static_cast<lapack_int>(k.rows());
  Eigen::VectorXd values(n);
  Eigen::MatrixXd vectors(n, count);
  std::vector<lapack_int> failed(static_cast<std::size_t>(n));
  lapack_int found = 0;
  // Twice the underflow threshold is LAPACK's own advice for the most accurate eigenvalues.
  const double tolerance = 2 * LAPACKE_dlamch('S');
  const lapack_int info = LAPACKE_dsygvx(LAPACK_COL_MAJOR, 1, 'V', 'I', 'L', n, k.data(), n, m.data(), n, 0, 0, 1,
                                         count, tolerance, &found, values.data(), vectors.data(), n, failed.data());
  require_definite(info, n);
  require_lapack(info, "dsygvx");
  return {values.head(count), std::move(vectors)};
}

}  // namespace

Eigenpairs tridiagonal_eigenpairs(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& off_diagonal,
                                  std::size_t count) {
  const Eigen::Index n = diagonal.size();
  require(n > 0 && off_diagonal.size() == n - 1, "a tridiagonal matrix of size {} has {} off-diagonal elements, not {}",
          n, n - 1, off_diagonal.size());
  require(diagonal.allFinite() && off_diagonal.allFinite(), "a tridiagonal matrix has an element that is not finite");
  require_count(count, n);
  if (count == 0) return {Eigen::VectorXd(0), Eigen::MatrixXd(n, 0)};
  use_one_blas_thread();

  // dstevr orthogonalises a subset vector by vector, n·count². For the whole set its relatively robust representations
  // would cost 100 n², but LAPACK gives them up at some sizes (uniform rods of 4780 elements) for inverse iteration at
  // n³ with no word; divide and conquer is dependable.
  const auto size = static_cast<lapack_int>(n);
  Eigen::VectorXd d = diagonal, e(n);  // LAPACK overwrites them, and uses e up to n
  e << off_diagonal, 0;
  if (10 * count >= static_cast<std::size_t>(n)) {
    Eigen::MatrixXd vectors(n, n);
    require_lapack(LAPACKE_dstevd(LAPACK_COL_MAJOR, 'V', size, d.data(), e.data(), vectors.data(), size), "dstevd");
    return first({d, std::move(vectors)}, static_cast<Eigen::Index>(count));
  }
  const auto asked = static_cast<lapack_int>(count);
  Eigen::VectorXd values(n);
  Eigen::MatrixXd vectors(n, asked);
  std::vector<lapack_int> support(2 * count);
  lapack_int found = 0;
  require_lapack(LAPACKE_dstevr(LAPACK_COL_MAJOR, 'V', 'I', size, d.data(), e.data(), 0, 0, 1, asked,
                                2 * LAPACKE_dlamch('S'), &found, values.data(), vectors.data(), size, support.data()),
                 "dstevr");
  return first({values, std::move(vectors)}, static_cast<Eigen::Index>(count));
}

Eigenpairs dense_eigenpairs(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m, std::size_t count) {
  const Eigen::Index n = k.rows();
  require(n > 0 && k.cols() == n && m.rows() == n && m.cols() == n,
          "stiffness {} x {} and mass {} x {} are not square of the same size", k.rows(), k.cols(), m.rows(), m.cols());
  require(n <= largest_dense_size,
          "{} degrees of freedom are too many for a dense solution (at most {}); ask for fewer modes", n,
          largest_dense_size);
  require(k.allFinite() && m.allFinite(), "a stiffness or mass matrix has an element that is not finite");
  require_count(count, n);
  if (count == 0) return {Eigen::VectorXd(0), Eigen::MatrixXd(n, 0)};
  use_one_blas_thread();
  if (4 * count < static_cast<std::size_t>(n)) return lowest_dense(k, m, static_cast<lapack_int>(count));
  return first(all_dense(k, m), static_cast<Eigen::Index>(count));
}

}  // namespace impulse
