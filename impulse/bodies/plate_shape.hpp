#pragma once

#include <Eigen/Dense>

#include <array>

namespace impulse {

/// A convex quadrilateral by its corners in order round it, as the bilinear image of [-1, 1]²:
///
///   x(ξ, η) = Σ ¼ (1 ± ξ)(1 ± η) xᵢ      corner 1 at (-1, -1), 2 at (1, -1), 3 at (1, 1), 4 at (-1, 1)
///
/// Edge i runs from corner i to corner i + 1. Either sense of rotation will do; the Jacobian of a clockwise one is
/// negative.
struct PlateShape {
  std::array<Eigen::Vector2d, 4> corners;  ///< [m]

  [[nodiscard]] Eigen::Vector2d position(const Eigen::Vector2d& reference) const;

  /// [x_ξ y_ξ; x_η y_η].
  [[nodiscard]] Eigen::Matrix2d jacobian(const Eigen::Vector2d& reference) const;

  /// (x_ξη, y_ξη), the same everywhere; zero for a parallelogram.
  [[nodiscard]] Eigen::Vector2d twist() const;

  /// From corner `edge` to the next, edges counted from 0.
  [[nodiscard]] Eigen::Vector2d edge(std::size_t edge) const { return corners[(edge + 1) % 4] - corners[edge]; }

  /// Positive if the corners go round counter-clockwise.
  [[nodiscard]] double signed_area() const;

  /// Shortest distance of a point to the lines through the edges, positive inside.
  [[nodiscard]] double distance_to_boundary(const Eigen::Vector2d& position) const;

  /// The (ξ, η) of a point in the quadrilateral, by Newton's method.
  /// @throws ConvergenceError for a point far outside.
  [[nodiscard]] Eigen::Vector2d reference(const Eigen::Vector2d& position) const;
};

/// The rectangle (0, 0), (a, 0), (a, b), (0, b).
[[nodiscard]] PlateShape rectangle(double a_m, double b_m);

/// @throws std::invalid_argument naming the corner or edge that makes it degenerate, concave or crossing itself.
/// Verified by: tests/impulse/plate_shape.test.cpp
void require_valid(const PlateShape& shape);

}  // namespace impulse
