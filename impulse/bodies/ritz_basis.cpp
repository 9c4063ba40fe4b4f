#include "impulse/bodies/ritz_basis.hpp"

#include "lib/contract/require.hpp"
#include "lib/numerics/eigenpairs.hpp"
#include "lib/numerics/quadrature.hpp"

namespace impulse {
namespace {

/// T₀ ... Tₙ₋₁ (columns) and their derivatives at points (rows), from Tₖ₊₁ = 2x Tₖ - Tₖ₋₁ differentiated.
Eigen::MatrixXd chebyshev_at(const Eigen::VectorXd& x, Eigen::Index n, int order) {
  Eigen::MatrixXd lower;
  if (order > 0) lower = chebyshev_at(x, n, order - 1);
  Eigen::MatrixXd t = Eigen::MatrixXd::Zero(x.size(), n);
  if (order == 0) t.col(0).setOnes();
  if (n > 1 && order == 0) t.col(1) = x;
  if (n > 1 && order == 1) t.col(1).setOnes();
  for (Eigen::Index k = 1; k + 1 < n; ++k) {
    t.col(k + 1) = 2 * x.cwiseProduct(t.col(k)) - t.col(k - 1);
    if (order > 0) t.col(k + 1) += 2 * order * lower.col(k);
  }
  return t;
}

/// Combinations of neighbouring Chebyshev polynomials that vanish at both ends: Tₖ₊₂ - Tₖ; with their slopes,
/// Tₖ - 2(k+2)/(k+3) Tₖ₊₂ + (k+1)/(k+3) Tₖ₊₄.
Eigen::MatrixXd vanishing(Eigen::Index n, RitzBasis::Ends ends) {
  const Eigen::Index lost = ends == RitzBasis::Ends::values ? 2 : 4;
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(n, n - lost);
  for (Eigen::Index j = 0; j < c.cols(); ++j) {
    const auto k = static_cast<double>(j);
    c(j, j) = lost == 2 ? -1 : 1;
    c(j + 2, j) = lost == 2 ? 1 : -2 * (k + 2) / (k + 3);
    if (lost == 4) c(j + 4, j) = (k + 1) / (k + 3);
  }
  return c;
}

}  // namespace

RitzBasis::RitzBasis(std::size_t size, Ends ends) : ends_(ends) {
  const std::size_t least = ends == Ends::values ? 2 : 4;
  require(size >= least && size <= most_terms, "a series of {} terms a side is not within {} to {}", size, least,
          most_terms);
  const auto n = static_cast<Eigen::Index>(size), held = static_cast<Eigen::Index>(least);
  chebyshev_ = Eigen::MatrixXd::Zero(n, n);
  if (ends == Ends::values) {
    chebyshev_.topLeftCorner(2, 2) << 0.5, 0.5, -0.5, 0.5;
  } else {
    // Hermite's cubics (2 ∓ 3x ± x³)/4 and (±1 - x ∓ x² + x³)/4, with x² = (T₂ + 1)/2 and x³ = (T₃ + 3T₁)/4.
    chebyshev_.topLeftCorner(4, 4) << 2, 2, 0.5, -0.5,  //
        -2.25, 2.25, -0.25, -0.25,                      //
        0, 0, -0.5, 0.5,                                //
        0.25, -0.25, 0.25, 0.25;
    chebyshev_.topLeftCorner(4, 4) /= 4;
  }
  if (n == held) return;
  const Eigen::MatrixXd inner = vanishing(n, ends);
  const QuadratureRule rule = gauss_legendre(size);
  const Eigen::MatrixXd value = chebyshev_at(rule.points, n, 0) * inner;
  const Eigen::MatrixXd change = chebyshev_at(rule.points, n, ends == Ends::values ? 1 : 2) * inner;
  const Eigen::MatrixXd mass = value.transpose() * rule.weights.asDiagonal() * value;
  const Eigen::MatrixXd stiffness = change.transpose() * rule.weights.asDiagonal() * change;
  chebyshev_.rightCols(n - held) =
      inner * dense_eigenpairs(stiffness, mass, static_cast<std::size_t>(n - held)).vectors;
}

Eigen::MatrixXd RitzBasis::at(const Eigen::VectorXd& points, int order) const {
  return chebyshev_at(points, size(), order) * chebyshev_;
}

}  // namespace impulse
