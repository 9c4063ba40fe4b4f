#pragma once

#include "fem/shell/shell.hpp"
#include "lib/model/structure.hpp"
#include "lib/numerics/sparse_cholesky.hpp"

#include <Eigen/Dense>

#include <cstddef>

namespace impulse {

/// Vectors Ψ in whose span a body's motion is sought, q = Ψz; M-orthonormal, ΨᵀMΨ = 1.
struct ReducedBasis {
  Eigen::MatrixXd vectors;    ///< n × m
  Eigen::MatrixXd stiffness;  ///< ΨᵀKΨ, m × m [1/s²]
};

enum class ModeKind {
  any,
  flexural,  ///< more than half of the kinetic energy is along the normals
};

/// The lowest modes of vibration, natural ones first; stiffness diag(ω²).
/// @throws std::invalid_argument if the mesh has fewer modes of the kind, or the panel can move as a rigid body.
/// Verified by: tests/fem/reduced_basis.test.cpp
[[nodiscard]] ReducedBasis modal_basis(const Shell& shell, const Structure& body, std::size_t count, ModeKind kind);

/// Share of the kinetic energy of each column that is along the surface's normals, 0 to 1.
[[nodiscard]] Eigen::VectorXd normal_share(const Shell& shell, const Eigen::MatrixXd& modes);

/// Wilson's Ritz vectors of a load p, each M-orthonormalised against all before, twice:
///
///   K ψ₁* = p,   K ψᵢ₊₁* = M ψᵢ
///
/// They stop early, with fewer vectors, where the next one is rounding: the load then excites no more.
/// `inverse` is b → K⁻¹b. Reference: [Wilson1982].
/// Cost: a solution, a product with each matrix and 4 n·count multiplications per vector.
/// @throws std::invalid_argument for more vectors than unknowns or a zero load.
/// Verified by: tests/fem/reduced_basis.test.cpp
[[nodiscard]] ReducedBasis ritz_basis(const LinearSolver& inverse, const Eigen::SparseMatrix<double>& stiffness,
                                      const Eigen::SparseMatrix<double>& mass, const Eigen::VectorXd& load,
                                      std::size_t count);

/// With K factorised here. @throws std::invalid_argument if it can't be.
[[nodiscard]] ReducedBasis ritz_basis(const Eigen::SparseMatrix<double>& stiffness,
                                      const Eigen::SparseMatrix<double>& mass, const Eigen::VectorXd& load,
                                      std::size_t count);

/// The basis with what the other vectors add to it, M-orthonormalised; vectors that add less than 1e-6 of their length
/// are left out. The first coordinates keep their meaning. The stiffness is with respect to `stiffness`.
[[nodiscard]] ReducedBasis appended(const ReducedBasis& basis, const Eigen::MatrixXd& vectors,
                                    const Eigen::SparseMatrix<double>& stiffness,
                                    const Eigen::SparseMatrix<double>& mass);

}  // namespace impulse
