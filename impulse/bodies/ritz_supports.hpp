#pragma once

#include "impulse/bodies/plate.hpp"

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <array>
#include <cstddef>

namespace impulse {

/// Coefficients of a Ritz plate's series that edges leave and those that they hold. The series are those of
/// PlateField that the plate has, one after the other, coefficient i·n + j of the functions i of ξ and j of η
/// (RitzBasis), n terms a side. On an oblique edge a vector (u, v) or (φx, φy) is turned into its normal and tangential
/// part; where edges meet, what either holds is held.
/// Verified by: tests/impulse/ritz_plate.test.cpp
struct SeriesSupports {
  Eigen::SparseMatrix<double> unheld;  ///< coefficients from unknowns
  Eigen::SparseMatrix<double> held;    ///< coefficients from what the edges hold: the orthogonal complement
};

[[nodiscard]] SeriesSupports series_supports(const Plate& plate, Eigen::Index n);

/// (ξ, η) along an edge, s from -1 to 1.
[[nodiscard]] Eigen::Vector2d along_edge(std::size_t edge, double s);

/// The motions of an edge in the directions of HeldEdge and EdgeSprings (rows) from PlateMotionRow (columns).
[[nodiscard]] Eigen::Matrix<double, 5, 5> edge_motions(const PlateShape& shape, std::size_t edge);

/// HeldEdge and EdgeSprings in the order of those rows.
[[nodiscard]] std::array<bool, 5> held_motions(const HeldEdge& edge);
[[nodiscard]] std::array<double, 5> spring_stiffness(const EdgeSprings& edge);

}  // namespace impulse
