#pragma once

#include "impulse/bodies/plate_kinematics.hpp"
#include "impulse/bodies/ritz_basis.hpp"
#include "lib/model/structure.hpp"

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <cstddef>
#include <vector>

namespace impulse {

/// A plate as a Ritz body (Kapania and Lovejoy): u, v, w and, with shear deformation, the rotations φx, φy of the
/// normal are double series of `terms` × `terms` polynomials in the coordinates (ξ, η) of the quadrilateral, T₀ ...
/// Tₙ₋₁ recombined (RitzBasis). With the strains (ε, κ, γ) of plate_kinematics.hpp
///
///   U = ½ ∫ [ε κ] [A B; B D] [ε κ]ᵀ + γᵀ k S γ dA,   T = ½ ∫ I₀(u̇² + v̇² + ẇ²) + 2 I₁(u̇φ̇x + v̇φ̇y) + I₂(φ̇x² + φ̇y²) dA
///
/// where `thin` has, as classical plates do, no rotary inertia: I₁ = I₂ = 0.
/// Edge conditions hold exactly, since they concern single functions of the basis; springs add to U.
/// [KapaniaLovejoy1996]. Verified by: tests/impulse/ritz_plate.test.cpp, tests/impulse/ritz_plate_published.test.cpp
class RitzPlate {
 public:
  /// @throws std::invalid_argument as require_valid(plate) and RitzBasis, and if the edges hold every term.
  RitzPlate(const Plate& plate, std::size_t terms);

  [[nodiscard]] Eigen::Index unknown_count() const { return coefficients_.cols(); }
  [[nodiscard]] std::size_t term_count() const { return static_cast<std::size_t>(values_.size()); }
  [[nodiscard]] const Plate& plate() const { return plate_; }

  /// Coefficients of all series, those of the fields one after the other, from the unknowns.
  [[nodiscard]] const Eigen::SparseMatrix<double>& coefficients() const { return coefficients_; }

  /// K and M of all coefficients, as if the edges held nothing.
  [[nodiscard]] Eigen::MatrixXd unheld_stiffness() const;
  [[nodiscard]] Eigen::MatrixXd unheld_mass() const;

  /// Work of loads on all coefficients.
  [[nodiscard]] Eigen::VectorXd unheld_work(const std::vector<PlateLoad>& loads) const;

  /// K [N/m] and M [kg], without contacts. Cost: 2 n⁴ Q operations for every pair of fields, n terms, Q points a side.
  [[nodiscard]] DenseStructure structure() const;

  /// Functionals of the unknowns (columns for Structure's contacts and outputs) at a point, given in (ξ, η).
  [[nodiscard]] Eigen::VectorXd deflection(const Eigen::Vector2d& reference) const;

  /// Deflection averaged over a disc about a point, which is the work of a uniform pressure on it. Exact to rounding.
  /// @throws std::invalid_argument if the disc leaves the plate.
  [[nodiscard]] Eigen::VectorXd mean_deflection(const Eigen::Vector2d& reference, double radius_m) const;

  /// Columns εx, εy, γxy at a point and height z [m], -h/2 ≤ z ≤ h/2; the struck face is at -h/2.
  [[nodiscard]] Eigen::MatrixXd strains(const Eigen::Vector2d& reference, double z_m) const;

 private:
  [[nodiscard]] std::vector<FormField> on_series(const std::vector<FieldOperator>& fields) const;
  [[nodiscard]] Eigen::MatrixXd of_unknowns(const Eigen::MatrixXd& form) const;
  void add_springs(Eigen::MatrixXd& stiffness) const;

  Plate plate_;
  RitzBasis values_;                          ///< of u, v and the rotations
  RitzBasis slopes_;                          ///< of w in `thin`
  Eigen::SparseMatrix<double> coefficients_;  ///< from unknowns
};

}  // namespace impulse
