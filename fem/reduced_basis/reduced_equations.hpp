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

/// A shell by its modes with tensors for the nonlinearity, free of the mesh:
///
///   q = Φz + Φ'y + x    Φ: n modes of finite amplitude, Φ': other modes, x: what follows statically
///   E = E₄(z) + ½ Σ ω'² y² + yᵀΦ'ᵀF p(z) - ½ pᵀG p,   F p = ∂(cubic energy)/∂q at Φz,  G = Fᵀ(K⁻¹ - Σ φφᵀ/ω²)F
///
/// E₄ is exact in Φ; in y and x the energy keeps what is linear in them beside products of z. For a flat plate, where x
/// and y are in its plane, that is von Kármán's theory without in-plane inertia; for a curved one they are bending too
/// and their own amplitude is taken to be small. Without x a curved panel would be several times too stiff.
/// Verified by: tests/fem/quartic_energy.test.cpp
struct TensorModel {
  ReducedBasis modes;         ///< Φ, then Φ'
  QuarticEnergy energy;       ///< E₄ - ½pᵀGp
  Eigen::MatrixXd companion;  ///< Φ'ᵀF
  Eigen::MatrixXd slaved;     ///< x = slaved · p(z), for strains and displacements of the whole body
};

/// @throws std::invalid_argument as quartic_reduction, or if more nonlinear modes are asked for than there are.
[[nodiscard]] TensorModel tensor_model(const Shell& shell, const Structure& body, const ReducedBasis& modes,
                                       std::size_t nonlinear_count);

[[nodiscard]] std::unique_ptr<MotionEquations> tensor_equations(const TensorModel& model);

/// q of coordinates (z, y).
[[nodiscard]] Eigen::VectorXd expanded(const TensorModel& model, const Eigen::VectorXd& coordinates);

}  // namespace impulse
