#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

namespace impulse {

// Of each function here there is one for Matrix = Eigen::SparseMatrix<double> and one for Eigen::MatrixXd.

/// A rigid-body mode: one whose strain energy is rounding, |uᵀKu| ≤ 256 ε |u|ᵀ|K||u|. The right-hand side is the sum
/// of the magnitudes that cancel in uᵀKu, so the test does not depend on units, of length, of mass or of rotations
/// among displacements. Rigid-body modes of assembled bodies reach a few ε; the first bending mode of a beam of 1000
/// elements is at 1e-11.
template <class Matrix>
[[nodiscard]] bool is_rigid(const Matrix& k, const Eigen::Ref<const Eigen::VectorXd>& u);

/// The lowest elastic (not rigid-body) eigenvalue of K u = λ M u within a factor of a few, never below it; 0 if K has
/// no elastic mode. Block inverse iteration about falling negative shifts, until the shift is no larger than the value
/// found.
/// @throws std::invalid_argument if K is not positive semidefinite. Cost: two to five factorisations.
template <class Matrix>
[[nodiscard]] double elastic_eigenvalue_scale(const Matrix& k, const Matrix& m);

/// The rigid-body modes as they are in exact arithmetic: elastic parts removed, UᵀMU = 1. `scale`:
/// elastic_eigenvalue_scale.
template <class Matrix>
[[nodiscard]] Eigen::MatrixXd purified_rigid_modes(const Matrix& k, const Matrix& m, const Eigen::MatrixXd& rigid,
                                                   double scale);

/// Static displacements X = P K⁻ Pᵀ C [m/N], n × p, of the elastic modes under unit forces at the contacts; CᵀX is the
/// static flexibility. With rigid-body modes U the loads are balanced by inertia, Pᵀ = I - M U Uᵀ, and the
/// displacements freed of rigid motion (inertia relief); without, X = K⁻¹C. `rigid` must hold all rigid-body modes.
/// `scale`: elastic_eigenvalue_scale.
/// @throws ConvergenceError if the refinement does not converge. Cost: a factorisation, a few solutions per contact.
template <class Matrix>
[[nodiscard]] Eigen::MatrixXd static_displacements(const Matrix& k, const Matrix& m, const Eigen::MatrixXd& rigid,
                                                   const Eigen::MatrixXd& contacts, double scale);

}  // namespace impulse
