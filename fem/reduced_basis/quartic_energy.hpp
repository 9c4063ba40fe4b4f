#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <functional>

namespace impulse {

/// Energy of a body in the coordinates z of a basis, an exact polynomial of degree four, by its derivative
///
///   ∂E/∂z = K z + A p(z) + B t(z),   p = (z_j z_k, j ≤ k),   t = (z_j z_k z_l, j ≤ k ≤ l)
///
/// The coefficients are those of one polynomial E, that is, symmetric tensors; E = zᵀ(Kz/2 + Ap/3 + Bt/4).
/// Index of (j, k): k(k+1)/2 + j; of (j, k, l): l(l+1)(l+2)/6 + k(k+1)/2 + j.
/// Cost of a force: n C(n+2, 3) multiplications with addition, whatever the mesh.
struct QuarticEnergy {
  Eigen::MatrixXd stiffness;  ///< K, n × n
  Eigen::MatrixXd quadratic;  ///< A, n × n(n+1)/2
  Eigen::MatrixXd cubic;      ///< B, n × n(n+1)(n+2)/6

  [[nodiscard]] Eigen::Index size() const { return stiffness.rows(); }
  [[nodiscard]] Eigen::VectorXd force(const Eigen::VectorXd& z, const Eigen::VectorXd& pairs) const;  ///< pairs: p(z)
  [[nodiscard]] double energy(const Eigen::VectorXd& z) const;
  [[nodiscard]] Eigen::MatrixXd tangent(const Eigen::VectorXd& z) const;  ///< ∂²E/∂z²
};

/// p(z).
[[nodiscard]] Eigen::VectorXd pair_products(const Eigen::VectorXd& z);

/// ∂p/∂z, a row per pair.
[[nodiscard]] Eigen::MatrixXd pair_derivatives(const Eigen::VectorXd& z);

/// A body of quartic energy seen from a basis: the tensors, and what the quadratic part of the internal force does
/// outside the basis.
struct QuarticReduction {
  QuarticEnergy energy;
  Eigen::MatrixXd quadratic_force;  ///< one column per pair: the whole body's quadratic force is this times p(z)
};

/// Tensors of the internal force f, exactly cubic with tangent `stiffness` at rest, in the columns of `basis`: found
/// from its values at sums and differences of up to three basis vectors, n + 3n(n-1)/2 + ... ≈ n³/6 of them, each at
/// `amplitude` (the largest displacement that it means, so that all orders are of one size).
/// The tensors are exact up to the rounding of those values.
/// @throws std::invalid_argument if sizes disagree or there are more than 40 vectors, where evaluating the mesh is
/// cheaper. Cost: about n³/6 internal forces. Verified by: tests/fem/quartic_energy.test.cpp
[[nodiscard]] QuarticReduction quartic_reduction(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& internal_force,
    const Eigen::SparseMatrix<double>& stiffness, const Eigen::MatrixXd& basis, const Eigen::VectorXd& amplitude);

/// Adds -½ pᵀGp to the energy, G symmetric with one row per pair: what coordinates that follow statically, y = -H⁻¹Fp
/// with their stiffness H and G = FᵀH⁻¹F, take from it.
void condense(QuarticEnergy& energy, const Eigen::MatrixXd& g);

}  // namespace impulse
