#pragma once

#include "impulse/bodies/point_singularity.hpp"
#include "impulse/bodies/ritz_plate.hpp"

#include <Eigen/Dense>

#include <vector>

namespace impulse {

/// What the series of a thin plate lack of its static answer to unit point forces. Under a force the deflection is
/// r² ln r and the strain ln r, which polynomials approach like n⁻² and, oscillating all over the plate, n⁻¹. The whole
/// answer is
///
///   s + h + x,   K x = c - ∫ σ(s + h)·ε
///
/// s the PointSingularity, h series that give s + h the motions that edges hold (least squares along the edges), x
/// series of the unknowns. h + x is as smooth as the forces' images outside the plate are far, and its series converge
/// by powers: 12 terms a side give four digits of the strains. Of the series alone, K x₀ = c, there is missing
/// s + h + x - x₀. For a free plate these are elastic answers, the inertia relieved. A panel's curvature leaves r⁴ ln
/// r. Limits: a force close to an edge leaves its image there; the tests' 12 terms hold for one at half the way to the
/// edge. Cost: the stiffness of all coefficients, a factorisation, and 4 (n + 12)² points' functionals a force.
/// Verified by: tests/impulse/missing_answer.test.cpp
class MissingAnswer {
 public:
  /// `body` is plate.structure(); the points of the forces are given in (ξ, η).
  /// @throws std::invalid_argument in shear theory, where the answer has no limit.
  MissingAnswer(const RitzPlate& plate, const DenseStructure& body, const std::vector<Eigen::Vector2d>& forces);

  /// Missing deflection at a point, for each force [m/N].
  [[nodiscard]] Eigen::RowVectorXd deflection(const Eigen::Vector2d& reference) const;

  /// Missing strains εx, εy, γxy (rows) at a point and height [1/N]; zero at the force itself, where they are infinite.
  [[nodiscard]] Eigen::MatrixXd strains(const Eigen::Vector2d& reference, double z_m) const;

  /// Missing deflections of the points struck under each other's forces, symmetric.
  [[nodiscard]] Eigen::MatrixXd flexibility() const;

 private:
  /// Work of a load on s of a force.
  [[nodiscard]] double singular_work(const PlateLoad& load, std::size_t force) const;
  [[nodiscard]] std::vector<PlateLoad> loads(std::size_t force) const;
  [[nodiscard]] Eigen::VectorXd spring_work(std::size_t force) const;
  [[nodiscard]] Eigen::MatrixXd held_series() const;
  [[nodiscard]] Eigen::RowVectorXd missing(const PlateLoad& load) const;

  RitzPlate plate_;
  std::vector<FieldOperator> strains_, motions_;
  PointSingularity singularity_;
  std::vector<Eigen::Vector2d> forces_;
  Eigen::MatrixXd series_;  ///< coefficients of h + x - x₀, a column for each force
};

}  // namespace impulse
