#pragma once

#include <Eigen/Dense>

#include <cstddef>

namespace impulse {

/// Polynomials of degree < n on [-1, 1], T₀ ... Tₙ₋₁ recombined so that conditions at the ends belong to single
/// functions and the others are as nearly independent as can be:
///
///   function 0, 1                   value 1 at -1 and at +1, 0 at the other end
///   function 2, 3 (of `slopes`)     slope 1 at -1 and at +1, 0 at the other end, value 0 at both
///   the others                      vanish at both ends, of `slopes` with their slopes; they diagonalise both their
///                                   mass ∫fg (to the unit matrix) and their stiffness ∫f'g', of `slopes` ∫f''g''
///
/// The first are of the lowest degree, linear or cubic: without stiffness against the others.
class RitzBasis {
 public:
  enum class Ends { values, slopes };

  /// @throws std::invalid_argument unless n ≥ 2, of `slopes` n ≥ 4, and n ≤ most_terms.
  RitzBasis(std::size_t size, Ends ends);

  [[nodiscard]] Eigen::Index size() const { return chebyshev_.cols(); }
  [[nodiscard]] Ends ends() const { return ends_; }

  /// Derivative of order 0, 1 or 2 of every function (column) at every point (row).
  [[nodiscard]] Eigen::MatrixXd at(const Eigen::VectorXd& points, int order) const;

  static constexpr std::size_t most_terms = 80;

 private:
  Ends ends_;
  Eigen::MatrixXd chebyshev_;  ///< column j: coefficients of T₀, T₁, ... of function j
};

}  // namespace impulse
