#include "lib/model/structure_eigenpairs.hpp"

#include "lib/contract/require.hpp"
#include "lib/model/rigid_modes.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Route = ModalOptions::Route;

/// No element further than `width` from the diagonal.
bool is_banded(const Sparse& a, Eigen::Index width) {
  for (Eigen::Index j = 0; j < a.outerSize(); ++j)
    for (Sparse::InnerIterator it(a, j); it; ++it)
      if (it.value() != 0 && std::abs(it.row() - it.col()) > width) return false;
  return true;
}

/// With T = D^-1/2 K D^-1/2, M = D diagonal:  T z = λ z,  u = D^-1/2 z.
Eigenpairs tridiagonal_route(const Sparse& k, const Sparse& m, std::size_t count) {
  const Eigen::Index n = k.rows();
  const Eigen::VectorXd mass = m.diagonal();
  const Eigen::VectorXd stiffness = k.diagonal();
  Eigen::VectorXd off_diagonal(n - 1);
  for (Eigen::Index i = 0; i + 1 < n; ++i) off_diagonal(i) = k.coeff(i + 1, i) / std::sqrt(mass(i) * mass(i + 1));
  Eigenpairs pairs = tridiagonal_eigenpairs(stiffness.cwiseQuotient(mass), off_diagonal, count);
  pairs.vectors = mass.cwiseSqrt().cwiseInverse().asDiagonal() * pairs.vectors;
  return pairs;
}

/// Up to here all modes of a dense matrix take no more time (a few ms) than finding out how to do without. Not more,
/// because ARPACK about the lowest modes is the more accurate for them (see eigenpairs.hpp): for a free beam of 290
/// elements the first elastic frequency comes to 1e-9 instead of 1e-6.
constexpr Eigen::Index small_size = 200;

Route chosen_route(const Sparse& k, const Sparse& m, std::size_t count) {
  const auto n = static_cast<std::size_t>(k.rows());
  if (is_banded(m, 0) && is_banded(k, 1)) return Route::tridiagonal;
  // Measured on a square membrane: at n = 900 dense 0.12 s, ARPACK 0.55 s for 400 modes; at n = 3600 7.9 s against
  // 1.6 s. They meet near a fifth of the modes.
  return k.rows() <= small_size || 5 * count >= n ? Route::dense : Route::arpack;
}

/// How many of the lowest modes to compute so that none up to the options' limits is missing; a few more do no harm.
std::size_t sufficient_count(const Sparse& k, const Sparse& m, const ModalOptions& options, double limit) {
  const auto n = static_cast<std::size_t>(k.rows());
  const std::size_t count = std::min(n, options.mode_count);
  if (std::isinf(limit) || k.rows() <= small_size) return count;
  // Above the rigid-body modes, whose computed eigenvalues are not quite 0, even if the limit is 0.
  const double above = std::max(limit * (1 + 1e-6), 0.1 * elastic_eigenvalue_scale(k, m));
  return std::min(count, eigenvalue_count_below(k, m, above) + 1);
}

}  // namespace

Eigenpairs structure_eigenpairs(const Sparse& k, const Sparse& m, const ModalOptions& options, double limit) {
  const std::size_t count = sufficient_count(k, m, options, limit);
  const Route route = options.route;
  switch (route == Route::automatic ? chosen_route(k, m, count) : route) {
    case Route::tridiagonal:
      require(is_banded(m, 0) && is_banded(k, 1),
              "the tridiagonal route takes a diagonal mass and a tridiagonal stiffness matrix; use the dense or the "
              "arpack route");
      return tridiagonal_route(k, m, count);
    case Route::arpack: {
      // The shift of the size of the lowest elastic eigenvalue: the rigid-body modes do not then drown it (see
      // shift_invert_eigenpairs), and K + scale·M is well conditioned.
      const double scale = elastic_eigenvalue_scale(k, m);
      return shift_invert_eigenpairs(k, m, count, scale > 0 ? -scale : -1);
    }
    default:
      return dense_eigenpairs(Eigen::MatrixXd(k), Eigen::MatrixXd(m), count);
  }
}

Eigenpairs structure_eigenpairs(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m, const ModalOptions& options,
                                double limit) {
  require(options.route == Route::automatic || options.route == Route::dense,
          "a dense structure takes the dense route only");
  const double scale = elastic_eigenvalue_scale(k, m);
  const std::size_t count = std::min(static_cast<std::size_t>(k.rows()), options.mode_count);
  // Rigid-body modes are above a limit of 0 by rounding.
  return lowest_dense_eigenpairs(k, m, scale > 0 ? scale : 1, count, std::max(limit, 0.1 * scale));
}

}  // namespace impulse
