#include "lib/model/rigid_modes.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/numerics/dense_algebra.hpp"
#include "lib/numerics/eigenpairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <type_traits>

namespace impulse {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <class Matrix>
Eigen::MatrixXd orthonormalised(const Matrix& m, const Eigen::MatrixXd& u) {
  const Eigen::MatrixXd gram = u.transpose() * (m * u);
  return gram.llt().matrixU().solve<Eigen::OnTheRight>(u);
}

/// Ritz pairs of the span of x.
template <class Matrix>
Eigenpairs ritz_pairs(const Matrix& k, const Matrix& m, const Eigen::MatrixXd& x) {
  // Inverse iteration about a small shift leaves the columns nearly parallel to the rigid-body modes.
  const Eigen::MatrixXd q =
      Eigen::HouseholderQR<Eigen::MatrixXd>(x).householderQ() * Eigen::MatrixXd::Identity(x.rows(), x.cols());
  Eigenpairs pairs =
      dense_eigenpairs(q.transpose() * (k * q), q.transpose() * (m * q), static_cast<std::size_t>(x.cols()));
  pairs.vectors = q * pairs.vectors;
  return pairs;
}

Eigen::MatrixXd start_block(Eigen::Index n, Eigen::Index columns) {
  std::mt19937_64 engine(5489);
  return Eigen::MatrixXd::NullaryExpr(n, columns,
                                      [&engine] { return std::ldexp(static_cast<double>(engine() >> 11), -52) - 1; });
}

void require_grounded(bool is_definite, double shift) {
  require(is_definite, "the stiffness matrix is not positive semidefinite (K + {}·M is not positive definite)", shift);
}

/// Factorised K + shift·M: positive definite for a body that may be free.
template <class Matrix>
class Grounded;

template <>
class Grounded<Sparse> {
 public:
  Grounded(const Sparse& k, const Sparse& m, double shift) : factor_(k + shift * m) {
    require_grounded(factor_.info() == Eigen::Success && (factor_.vectorD().array() > 0).all(), shift);
  }
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const { return factor_.solve(b); }

 private:
  Eigen::SimplicialLDLT<Sparse> factor_;
};

template <>
class Grounded<Eigen::MatrixXd> {
 public:
  Grounded(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m, double shift)
      : factor_(DenseCholesky::of(k + shift * m)) {
    require_grounded(factor_.has_value(), shift);
  }
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const { return factor_->solve(b); }

 private:
  std::optional<DenseCholesky> factor_;
};

/// Ritz value of the lowest mode in the block that is not rigid, 0 if all are.
template <class Matrix>
double lowest_elastic(const Matrix& k, const Eigenpairs& pairs) {
  for (Eigen::Index i = 0; i < pairs.values.size(); ++i)
    if (!is_rigid(k, pairs.vectors.col(i))) return pairs.values(i);
  return 0;
}

/// The largest Rayleigh quotient of a single degree of freedom: of the order of the largest eigenvalue, never above it.
template <class Matrix>
double top_eigenvalue_scale(const Matrix& k, const Matrix& m) {
  return (k.diagonal().array() / m.diagonal().array()).maxCoeff();
}

/// A smaller shift is lost in the rounding of K.
template <class Matrix>
double least_shift(const Matrix& k, const Matrix& m) {
  return 64 * epsilon * top_eigenvalue_scale(k, m);
}

/// The shift that grounds a free body. An iteration leaves shift/(λ + shift) of an error: 1 % or less, but for bodies
/// so finely divided that their lowest mode is itself near the rounding of K.
template <class Matrix>
double grounding_shift(const Matrix& k, const Matrix& m, double scale) {
  return std::max(0.01 * scale, least_shift(k, m));
}

}  // namespace

template <class Matrix>
bool is_rigid(const Matrix& k, const Eigen::Ref<const Eigen::VectorXd>& u) {
  const Eigen::VectorXd magnitude = u.cwiseAbs();
  return std::abs(u.dot(k * u)) <= 256 * epsilon * magnitude.dot(k.cwiseAbs() * magnitude);
}

template <class Matrix>
double elastic_eigenvalue_scale(const Matrix& k, const Matrix& m) {
  const Eigen::Index n = k.rows();
  const double top = top_eigenvalue_scale(k, m);
  if (!(top > 0)) return 0;
  const double least = least_shift(k, m);
  // A sparse matrix is factorised again cheaply, and from a large shift safely. Of a dense one a factorisation is a
  // good part of the whole work, and a shift that most bodies' lowest mode is above mostly makes it the only one.
  double shift = (std::is_same_v<Matrix, Sparse> ? 1e-6 : 1e-12) * top;
  constexpr int attempts = 40;
  Eigen::MatrixXd x = start_block(n, std::min<Eigen::Index>(8, n));
  for (int i = 0; i < attempts; ++i) {
    const Grounded<Matrix> factor(k, m, shift);
    Eigenpairs pairs;
    for (int step = 0; step < 2; ++step) {
      x = factor.solve(m * x);
      pairs = ritz_pairs(k, m, x);
      x = pairs.vectors;
    }
    const double lowest = lowest_elastic(k, pairs);
    if (lowest == 0 && x.cols() == n) return 0;
    if (lowest == 0) {  // several unconnected bodies: more rigid-body modes than the block holds
      x = start_block(n, std::min(2 * x.cols(), n));
    } else if (shift <= 0.1 * lowest || shift == least) {
      return lowest;  // a shift among many modes mixes them, to Ritz values of the size of the shift: then go on
    } else {
      shift = std::max(0.05 * lowest, least);
    }
  }
  throw ConvergenceError(fmt::format("the lowest elastic eigenvalue is not found (it is below {})", shift), 1,
                         shift / top, attempts);
}

template <class Matrix>
Eigen::MatrixXd purified_rigid_modes(const Matrix& k, const Matrix& m, const Eigen::MatrixXd& rigid, double scale) {
  if (rigid.cols() == 0) return rigid;
  Eigen::MatrixXd u = orthonormalised(m, rigid);
  if (scale == 0) return u;
  const Grounded<Matrix> factor(k, m, grounding_shift(k, m, scale));
  // K u is the elastic part alone, and precise however small, since it is a sum of differences.
  for (int step = 0; step < 4; ++step) u = orthonormalised(m, u - factor.solve(k * u));
  return u;
}

template <class Matrix>
Eigen::MatrixXd static_displacements(const Matrix& k, const Matrix& m, const Eigen::MatrixXd& rigid,
                                     const Eigen::MatrixXd& contacts, double scale) {
  if (scale == 0) return Eigen::MatrixXd::Zero(contacts.rows(), contacts.cols());
  const bool is_free = rigid.cols() > 0;
  const Grounded<Matrix> factor(k, m, is_free ? grounding_shift(k, m, scale) : 0);
  const Eigen::MatrixXd weight = m * rigid;
  Eigen::MatrixXd loads = contacts - weight * (rigid.transpose() * contacts);
  // A contact that moves the body rigidly only leaves a load that is rounding. Accelerations, so that units do not
  // matter.
  const Eigen::VectorXd acceleration = m.diagonal().cwiseSqrt().cwiseInverse();
  for (Eigen::Index i = 0; i < loads.cols(); ++i)
    if (loads.col(i).cwiseProduct(acceleration).norm() <= 1e-11 * contacts.col(i).cwiseProduct(acceleration).norm())
      loads.col(i).setZero();
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(loads.rows(), loads.cols());
  // Solving with K + shift·M again and again for what is left removes the shift's effect.
  constexpr int steps = 20;
  double change = 0;
  for (int step = 0; step < steps; ++step) {
    Eigen::MatrixXd correction = factor.solve(loads - k * x);
    correction -= rigid * (weight.transpose() * correction);
    x += correction;
    const double previous = change;
    change = x.norm() == 0 ? 0 : correction.norm() / x.norm();
    if (change <= epsilon || (step > 1 && change < 1e-6 && change > previous / 2)) break;  // at the rounding
  }
  if (!(change < 1e-6))
    throw ConvergenceError("the static flexibility does not converge (the stiffness matrix is too nearly singular)",
                           1e-6, change, steps);
  return x;
}

template bool is_rigid(const Sparse&, const Eigen::Ref<const Eigen::VectorXd>&);
template bool is_rigid(const Eigen::MatrixXd&, const Eigen::Ref<const Eigen::VectorXd>&);
template double elastic_eigenvalue_scale(const Sparse&, const Sparse&);
template double elastic_eigenvalue_scale(const Eigen::MatrixXd&, const Eigen::MatrixXd&);
template Eigen::MatrixXd purified_rigid_modes(const Sparse&, const Sparse&, const Eigen::MatrixXd&, double);
template Eigen::MatrixXd purified_rigid_modes(const Eigen::MatrixXd&, const Eigen::MatrixXd&, const Eigen::MatrixXd&,
                                              double);
template Eigen::MatrixXd static_displacements(const Sparse&, const Sparse&, const Eigen::MatrixXd&,
                                              const Eigen::MatrixXd&, double);
template Eigen::MatrixXd static_displacements(const Eigen::MatrixXd&, const Eigen::MatrixXd&, const Eigen::MatrixXd&,
                                              const Eigen::MatrixXd&, double);

}  // namespace impulse
