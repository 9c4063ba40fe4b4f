#include "lib/numerics/eigenpairs.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/numerics/dense_algebra.hpp"
#include "lib/numerics/single_thread_blas.hpp"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

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

void require_dense(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m) {
  const Eigen::Index n = k.rows();
  require(n > 0 && k.cols() == n && m.rows() == n && m.cols() == n,
          "stiffness {} x {} and mass {} x {} are not square of the same size", k.rows(), k.cols(), m.rows(), m.cols());
  require(n <= largest_dense_size,
          "{} degrees of freedom are too many for a dense solution (at most {}); ask for fewer modes", n,
          largest_dense_size);
  require(k.allFinite() && m.allFinite(), "a stiffness or mass matrix has an element that is not finite");
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

/// The largest eigenpairs of a symmetric tridiagonal matrix, ascending, by relatively robust representations, which
/// give up now and then and say so; then by divide and conquer.
Eigen::MatrixXd largest_tridiagonal_vectors(const Eigen::VectorXd& d, const Eigen::VectorXd& e, lapack_int count) {
  const auto n = static_cast<lapack_int>(d.size());
  Eigen::VectorXd diagonal = d, off_diagonal(n), values(n);
  off_diagonal << e, 0;
  Eigen::MatrixXd vectors(n, count);
  std::vector<lapack_int> support(2 * static_cast<std::size_t>(count));
  lapack_int found = 0;
  lapack_logical try_relative_accuracy = 1;
  const lapack_int info =
      LAPACKE_dstemr(LAPACK_COL_MAJOR, 'V', 'I', n, diagonal.data(), off_diagonal.data(), 0, 0, n - count + 1, n,
                     &found, values.data(), vectors.data(), n, count, support.data(), &try_relative_accuracy);
  if (info == 0 && found == count) return vectors;
  diagonal = d;
  off_diagonal << e, 0;
  Eigen::MatrixXd all(n, n);
  require_lapack(LAPACKE_dstedc(LAPACK_COL_MAJOR, 'I', n, diagonal.data(), off_diagonal.data(), all.data(), n),
                 "dstedc");
  return all.rightCols(count);
}

/// How many of the μ, ascending, are wanted.
lapack_int wanted_count(const Eigen::VectorXd& mu, double shift, std::size_t count, double limit) {
  const double least = 1 / (limit * (1 + 1e-6) + shift);
  const auto within = (mu.array() >= least).count();
  return static_cast<lapack_int>(std::min(static_cast<std::size_t>(within), count));
}

/// λ = 1/μ - shift loses ε·μ_max/μ of itself; where that is more than 1e-12, the Rayleigh quotient is better.
void refine_high_values(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m, const Eigen::VectorXd& mu,
                        Eigenpairs& pairs) {
  const auto low = (mu.array() > 1e-4 * mu(0)).count();
  const Eigen::Index high = mu.size() - low;
  if (high == 0) return;
  const Eigen::MatrixXd u = pairs.vectors.rightCols(high);
  Eigen::MatrixXd ku = Eigen::MatrixXd::Zero(u.rows(), high), mu_products = Eigen::MatrixXd::Zero(u.rows(), high);
  add_transposed_product(k, u, ku);
  add_transposed_product(m, u, mu_products);
  for (Eigen::Index i = 0; i < high; ++i) {
    const double mass = u.col(i).dot(mu_products.col(i));
    pairs.values(low + i) = u.col(i).dot(ku.col(i)) / mass;
    pairs.vectors.col(low + i) /= std::sqrt(mass);
  }
}

/// Ascending; Rayleigh quotients may change the order within a cluster.
Eigenpairs sorted(const Eigenpairs& pairs) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(pairs.values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](Eigen::Index a, Eigen::Index b) { return pairs.values(a) < pairs.values(b); });
  return {pairs.values(order), pairs.vectors(Eigen::all, order)};
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
  require_dense(k, m);
  const Eigen::Index n = k.rows();
  require_count(count, n);
  if (count == 0) return {Eigen::VectorXd(0), Eigen::MatrixXd(n, 0)};
  use_one_blas_thread();
  if (4 * count < static_cast<std::size_t>(n)) return lowest_dense(k, m, static_cast<lapack_int>(count));
  return first(all_dense(k, m), static_cast<Eigen::Index>(count));
}

Eigenpairs lowest_dense_eigenpairs(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m, double shift, std::size_t count,
                                   double limit) {
  require_dense(k, m);
  require_count(count, k.rows());
  const auto n = static_cast<lapack_int>(k.rows());
  use_one_blas_thread();
  Eigen::MatrixXd factor = k + shift * m, reduced = m;
  require(LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', n, factor.data(), n) == 0,
          "the stiffness matrix is not positive semidefinite (K + {}·M is not positive definite)", shift);
  require_lapack(LAPACKE_dsygst(LAPACK_COL_MAJOR, 1, 'L', n, reduced.data(), n, factor.data(), n), "dsygst");
  Eigen::VectorXd d(n), e(std::max(n - 1, 1)), tau(std::max(n - 1, 1));
  require_lapack(LAPACKE_dsytrd(LAPACK_COL_MAJOR, 'L', n, reduced.data(), n, d.data(), e.data(), tau.data()), "dsytrd");
  Eigen::VectorXd all = d, off_diagonal = e;
  require_lapack(LAPACKE_dsterf(n, all.data(), off_diagonal.data()), "dsterf");
  const lapack_int wanted = wanted_count(all, shift, count, limit);
  if (wanted == 0) return {Eigen::VectorXd(0), Eigen::MatrixXd(n, 0)};

  Eigen::MatrixXd vectors = largest_tridiagonal_vectors(d, e.head(n - 1), wanted);
  require_lapack(
      LAPACKE_dormtr(LAPACK_COL_MAJOR, 'L', 'L', 'N', n, wanted, reduced.data(), n, tau.data(), vectors.data(), n),
      "dormtr");
  require_lapack(LAPACKE_dtrtrs(LAPACK_COL_MAJOR, 'L', 'T', 'N', n, wanted, factor.data(), n, vectors.data(), n),
                 "dtrtrs");
  const Eigen::VectorXd mu = all.tail(wanted).reverse();
  Eigenpairs pairs{mu.cwiseInverse().array() - shift, vectors.rowwise().reverse()};
  // They come with uᵀ(K + shift·M)u = 1, so uᵀMu = μ.
  for (Eigen::Index i = 0; i < wanted; ++i) pairs.vectors.col(i) /= std::sqrt(std::max(mu(i), 1e-300));
  refine_high_values(k, m, mu, pairs);
  return sorted(pairs);
}

}  // namespace impulse
