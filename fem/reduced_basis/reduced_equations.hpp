#pragma once

#include "fem/implicit/motion_equations.hpp"
#include "fem/reduced_basis/quartic_energy.hpp"
#include "fem/reduced_basis/reduced_basis.hpp"

#include <memory>

namespace impulse {

/// z̈ + ΨᵀKΨ z = Ψᵀ load. All equations here keep references to what they are made of.
[[nodiscard]] std::unique_ptr<MotionEquations> linear_equations(const ReducedBasis& basis);

/// z̈ + Ψᵀf(Ψz) = Ψᵀ load: the mesh is evaluated at every force.
[[nodiscard]] std::unique_ptr<MotionEquations> projected_equations(const Shell& shell, const ReducedBasis& basis);

/// A shell in a basis Ψ = (Φ, Φ') with tensors for the nonlinearity, free of the mesh:
///
///   q = Φz + Φ'y + x    z: of finite amplitude, y: small, x: what follows statically, K-orthogonal to Ψ
///   E = E₄(z) + yᵀΦ'ᵀK(Φz + ½Φ'y) + yᵀΦ'ᵀF p(z) - ½ pᵀG p
///   F p = ∂(cubic energy)/∂q at Φz,   G = Fᵀ(K⁻¹ - Ψ(ΨᵀKΨ)⁻¹Ψᵀ)F
///
/// E₄ is exact in Φ; in y and x the energy keeps what is linear in them beside products of z. For a flat plate with x
/// and y in its plane that is von Kármán's theory without in-plane inertia; for a curved one they are bending too
/// and their own amplitude is taken to be small. Without x a curved panel would be several times too stiff. What Φ must
/// hold is the deflection under the force, dimple included: a dozen Ritz vectors do, where as many modes do not.
/// Verified by: tests/fem/quartic_energy.test.cpp, tests/fem/panel_impact.test.cpp
struct TensorModel {
  ReducedBasis basis;         ///< Φ, then Φ' with a diagonal Φ'ᵀKΦ'
  QuarticEnergy energy;       ///< E₄ - ½pᵀGp
  Eigen::MatrixXd companion;  ///< Φ'ᵀF
  Eigen::MatrixXd slaved;     ///< x = slaved · p(z), for strains and displacements of the whole body
};

/// The first `nonlinear_count` vectors are Φ, the others are turned among themselves to be Φ'; `factor` is that of the
/// body's stiffness.
/// @throws std::invalid_argument as quartic_reduction, or if more nonlinear vectors are asked for than there are.
/// Cost: n³/6 internal forces and n(n + 1)/2 solutions, n = nonlinear_count.
[[nodiscard]] TensorModel tensor_model(const Shell& shell, const Structure& body, const SparseCholesky& factor,
                                       const ReducedBasis& given, std::size_t nonlinear_count);

[[nodiscard]] std::unique_ptr<MotionEquations> tensor_equations(const TensorModel& model);

/// q of coordinates (z, y).
[[nodiscard]] Eigen::VectorXd expanded(const TensorModel& model, const Eigen::VectorXd& coordinates);

}  // namespace impulse
