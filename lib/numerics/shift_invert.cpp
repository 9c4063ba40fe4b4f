#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/numerics/eigenpairs.hpp"
#include "lib/numerics/single_thread_blas.hpp"

#include <Eigen/SparseLU>

#include <arpack/arpack.hpp>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>
#include <random>

namespace impulse {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Fixed and without symmetry, so that it has a part in every mode. Bits rather than std::uniform_real_distribution,
/// whose values depend on the library.
Eigen::VectorXd start_vector(Eigen::Index n) {
  std::mt19937_64 engine(20240229);
  return Eigen::VectorXd::NullaryExpr(n,
                                      [&engine] { return std::ldexp(static_cast<double>(engine() >> 11), -52) - 1; });
}

/// LDLᵀ without pivoting is stable for a definite matrix only. For an indefinite one, elimination may blow up; a
/// solution that leaves a residual tells.
bool is_stable(const Eigen::SimplicialLDLT<Sparse>& factor, const Sparse& a, double tolerance = 1e-12) {
  if (factor.info() != Eigen::Success || !factor.vectorD().allFinite()) return false;
  if ((factor.vectorD().array() > 0).all()) return true;
  const Eigen::VectorXd b = start_vector(a.rows());
  const Eigen::VectorXd x = factor.solve(b);
  const Eigen::VectorXd scale = a.cwiseAbs() * x.cwiseAbs() + b.cwiseAbs();
  return x.allFinite() && ((a * x - b).array().abs() <= tolerance * scale.maxCoeff()).all();
}

std::size_t negative_count(const Eigen::SimplicialLDLT<Sparse>& factor) {
  return static_cast<std::size_t>((factor.vectorD().array() < 0).count());
}

/// (K - shift·M)⁻¹ by LDLᵀ, or by LU with pivoting where that is unstable.
class ShiftedInverse {
 public:
  ShiftedInverse(const Sparse& k, const Sparse& m, double shift) : a_(k - shift * m) {
    ldlt_.compute(a_);
    if (is_stable(ldlt_, a_)) return;
    lu_.emplace();
    lu_->compute(a_);
    require(lu_->info() == Eigen::Success,
            "K - {}·M cannot be factorised (the shift is an eigenvalue); use another shift", shift);
  }

  /// Number of eigenvalues below the shift, if LDLᵀ told it.
  [[nodiscard]] std::optional<std::size_t> below_count() const {
    return lu_ ? std::nullopt : std::optional(negative_count(ldlt_));
  }

  [[nodiscard]] Eigen::VectorXd solve(const Eigen::Ref<const Eigen::VectorXd>& b) const {
    if (lu_) return lu_->solve(b);
    return ldlt_.solve(b);
  }

 private:
  Sparse a_;
  Eigen::SimplicialLDLT<Sparse> ldlt_;
  std::optional<Eigen::SparseLU<Sparse>> lu_;
};

/// `count` eigenpairs next above the shift, M-orthogonal to the columns of `known`, in any order.
Eigenpairs arpack_eigenpairs(const ShiftedInverse& inverse, const Sparse& m, double shift, Eigen::Index count,
                             const Eigen::MatrixXd& known) {
  // ARPACK keeps its state in Fortran SAVE variables.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);

  const auto n = static_cast<a_int>(m.rows());
  const auto nev = static_cast<a_int>(count);
  const a_int ncv = std::min(n, std::max(2 * nev + 1, nev + 20));
  constexpr a_int max_restarts = 1000;
  // Relative, of 1/(λ - shift). Asking for ε itself would have ARPACK chase its own rounding.
  constexpr double tolerance = 1e-14;
  const auto deflate = [&known, &m](Eigen::Ref<Eigen::VectorXd> x) {
    if (known.cols() > 0) x -= known * (known.transpose() * (m * x)).eval();
  };

  Eigen::VectorXd residual = start_vector(n);
  deflate(residual);
  Eigen::MatrixXd basis(n, ncv);
  Eigen::VectorXd workd(3 * n), workl(ncv * (ncv + 8));
  a_int iparam[11] = {1, 0, max_restarts, 1, 0, 0, 3, 0, 0, 0, 0};  // exact shifts, mode 3: shift-invert
  a_int ipntr[14] = {};
  a_int ido = 0, info = 1;  // info = 1: start from `residual`
  const auto lworkl = static_cast<a_int>(workl.size());
  const auto part = [&workd, &ipntr, n](int i) { return workd.segment(ipntr[i] - 1, n); };
  std::size_t solve_count = 0;
  while (true) {
    // 'LA', the largest 1/(λ - shift): the nearest *above* the shift, where 'LM' would take those below as well.
    arpack::saupd(ido, arpack::bmat::generalized, n, arpack::which::largest_algebraic, nev, tolerance, residual.data(),
                  ncv, basis.data(), n, iparam, ipntr, workd.data(), workl.data(), lworkl, info);
    if (ido == 2) {
      part(1) = m * part(0);
    } else if (ido == -1 || ido == 1) {
      Eigen::VectorXd x = inverse.solve(ido == 1 ? Eigen::VectorXd(part(2)) : Eigen::VectorXd(m * part(0)));
      deflate(x);
      part(1) = x;
      ++solve_count;
    } else {
      break;
    }
  }
  const a_int converged = iparam[4];
  if (info != 0 || converged < nev)
    throw ConvergenceError(fmt::format("ARPACK finds {} of {} eigenpairs above {} in {} restarts (dsaupd info = {})",
                                       converged, nev, shift, iparam[2], info),
                           tolerance, 0, static_cast<std::size_t>(iparam[2]));

  std::vector<a_int> select(static_cast<std::size_t>(ncv));
  Eigen::VectorXd values(nev);
  Eigen::MatrixXd vectors(n, nev);
  arpack::seupd(1, arpack::howmny::ritz_vectors, select.data(), values.data(), vectors.data(), n, shift,
                arpack::bmat::generalized, n, arpack::which::largest_algebraic, nev, tolerance, residual.data(), ncv,
                basis.data(), n, iparam, ipntr, workd.data(), workl.data(), lworkl, info);
  if (info != 0)
    throw ConvergenceError(fmt::format("ARPACK cannot form its eigenvectors (dseupd info = {})", info), tolerance, 0,
                           static_cast<std::size_t>(iparam[2]));
  return {values, vectors, solve_count};
}

Eigenpairs joined(const Eigenpairs& a, const Eigenpairs& b) {
  Eigenpairs all{Eigen::VectorXd(a.values.size() + b.values.size()),
                 Eigen::MatrixXd(std::max(a.vectors.rows(), b.vectors.rows()), a.values.size() + b.values.size()),
                 a.solve_count + b.solve_count};
  all.values << a.values, b.values;
  all.vectors << a.vectors, b.vectors;
  return all;
}

Eigenpairs sorted(const Eigenpairs& pairs) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(pairs.values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&pairs](Eigen::Index i) { return pairs.values(i); });
  return {pairs.values(order), pairs.vectors(Eigen::all, order), pairs.solve_count};
}

/// How many of the ascending values lie below the gap that the inertia is to be counted in: the first gap at or above
/// `count`, or, if `count` cuts through a cluster that goes on to the end, the last gap below it; 0 if there is none.
Eigen::Index checked_count(const Eigen::VectorXd& values, Eigen::Index count, double shift) {
  // A gap where K - xM is well away from singular on both sides.
  const auto is_gap = [&](Eigen::Index i) { return values(i) - values(i - 1) > 1e-6 * (values(i) - shift); };
  for (Eigen::Index i = count; i < values.size(); ++i)
    if (is_gap(i)) return i;
  for (Eigen::Index i = std::min(count, values.size() - 1); i > 0; --i)
    if (is_gap(i)) return i;
  return 0;
}

}  // namespace

std::size_t eigenvalue_count_below(const Sparse& k, const Sparse& m, double x) {
  // A pivot lost to cancellation at x comes back when x moves by δ, at the cost of an error ε/δ: move further, and
  // demand less, by and by. Away from such a pivot the first attempt leaves 1e-15.
  constexpr int attempts = 7;
  double moved = x, step = 1e-13;
  for (int i = 0; i < attempts; ++i, step *= 10) {
    const Sparse a = k - moved * m;
    const Eigen::SimplicialLDLT<Sparse> factor(a);
    if (is_stable(factor, a, 10 * step)) return negative_count(factor);
    moved = x * (1 + 10 * step);
  }
  throw ConvergenceError(fmt::format("the eigenvalues below {} cannot be counted (the factorisation is unstable)", x),
                         1e-6, 1, attempts);
}

Eigenpairs shift_invert_eigenpairs(const Sparse& k, const Sparse& m, std::size_t count, double shift) {
  const Eigen::Index n = k.rows();
  require(n > 0 && k.cols() == n && m.rows() == n && m.cols() == n,
          "stiffness {} x {} and mass {} x {} are not square of the same size", k.rows(), k.cols(), m.rows(), m.cols());
  require(std::isfinite(shift), "the shift {} is not finite", shift);
  require(count < static_cast<std::size_t>(n),
          "ARPACK gives fewer eigenpairs than the size of the matrix, not {} of {}; use the dense method", count, n);
  if (count == 0) return {Eigen::VectorXd(0), Eigen::MatrixXd(n, 0)};
  use_one_blas_thread();

  const ShiftedInverse inverse(k, m, shift);
  const std::size_t below_shift = inverse.below_count() ? *inverse.below_count() : eigenvalue_count_below(k, m, shift);
  const auto available = n - static_cast<Eigen::Index>(below_shift);
  const auto wanted = static_cast<Eigen::Index>(count);
  require(wanted <= available, "{} eigenpairs asked above {}, where there are {}", count, shift, available);

  // Two to spare give a gap to count in above the last one wanted.
  constexpr Eigen::Index spare = 2;
  Eigenpairs found{Eigen::VectorXd(0), Eigen::MatrixXd(n, 0)};
  Eigen::Index ask = std::min({wanted + spare, available, n - 1});
  constexpr std::size_t rounds = 8;
  for (std::size_t round = 0; round < rounds; ++round) {
    found = sorted(joined(found, arpack_eigenpairs(inverse, m, shift, ask, found.vectors)));
    const Eigen::Index below_gap = checked_count(found.values, wanted, shift);
    if (below_gap == 0) break;
    const double gap = (found.values(below_gap - 1) + found.values(below_gap)) / 2;
    const auto counted = static_cast<Eigen::Index>(eigenvalue_count_below(k, m, gap) - below_shift);
    if (counted == below_gap) break;
    if (counted < below_gap || round + 1 == rounds)
      throw ConvergenceError(fmt::format("ARPACK finds {} eigenvalues between {} and {}, where the inertia counts {}",
                                         below_gap, shift, gap, counted),
                             static_cast<double>(counted), static_cast<double>(below_gap), round + 1);
    // A Krylov space holds one vector of a multiple eigenvalue: seek the others orthogonally to those found.
    ask = std::min(counted - below_gap + spare, n - found.values.size() - 1);
  }
  found.values.conservativeResize(wanted);
  found.vectors.conservativeResize(Eigen::NoChange, wanted);
  return found;
}

}  // namespace impulse
