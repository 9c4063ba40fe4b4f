#include "impulse/bodies/plate_shape.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace impulse {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Sine of the turn at a corner.
double turn(const PlateShape& shape, std::size_t corner) {
  const Eigen::Vector2d in = shape.edge((corner + 3) % 4), out = shape.edge(corner);
  return cross(in, out) / (in.norm() * out.norm());
}

}  // namespace

Eigen::Vector2d PlateShape::position(const Eigen::Vector2d& reference) const {
  const double a = reference.x(), b = reference.y();
  return ((1 - a) * (1 - b) * corners[0] + (1 + a) * (1 - b) * corners[1] + (1 + a) * (1 + b) * corners[2] +
          (1 - a) * (1 + b) * corners[3]) /
         4;
}

Eigen::Matrix2d PlateShape::jacobian(const Eigen::Vector2d& reference) const {
  const double a = reference.x(), b = reference.y();
  Eigen::Matrix2d result;
  result.row(0) = ((1 - b) * (corners[1] - corners[0]) + (1 + b) * (corners[2] - corners[3])) / 4;
  result.row(1) = ((1 - a) * (corners[3] - corners[0]) + (1 + a) * (corners[2] - corners[1])) / 4;
  return result;
}

Eigen::Vector2d PlateShape::twist() const { return (corners[0] - corners[1] + corners[2] - corners[3]) / 4; }

double PlateShape::signed_area() const { return cross(corners[2] - corners[0], corners[3] - corners[1]) / 2; }

double PlateShape::distance_to_boundary(const Eigen::Vector2d& position) const {
  const double sense = signed_area() > 0 ? 1 : -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i)
    least = std::min(least, sense * cross(edge(i), position - corners[i]) / edge(i).norm());
  return least;
}

Eigen::Vector2d PlateShape::reference(const Eigen::Vector2d& position) const {
  const double scale = std::sqrt(std::abs(signed_area()));
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  constexpr std::size_t most_steps = 60;
  double error = 0;
  for (std::size_t i = 0; i < most_steps; ++i) {
    const Eigen::Vector2d defect = position - this->position(at);
    error = defect.norm() / scale;
    const Eigen::Vector2d step = jacobian(at).transpose().inverse() * defect;
    at += step;
    // Quadratic: the step after one this small is rounding.
    if (step.norm() < 1e-9 * (1 + at.norm()) && error < 1e-6) return at;
  }
  throw ConvergenceError(fmt::format("no point of the plate is at x = {} m, y = {} m", position.x(), position.y()),
                         1e-6, error, most_steps);
}

PlateShape rectangle(double a_m, double b_m) { return {{{{0, 0}, {a_m, 0}, {a_m, b_m}, {0, b_m}}}}; }

void require_valid(const PlateShape& shape) {
  for (std::size_t i = 0; i < 4; ++i)
    require(shape.corners[i].allFinite(), "corner {} of the plate is not finite", i + 1);
  double size = 0;
  for (std::size_t i = 0; i < 4; ++i) size = std::max(size, shape.edge(i).norm());
  for (std::size_t i = 0; i < 4; ++i)
    require(shape.edge(i).norm() > 1e-6 * size, "edge {} of the plate has no length (corners {} and {} coincide)",
            i + 1, i + 1, (i + 1) % 4 + 1);
  std::array<double, 4> turns{};
  for (std::size_t i = 0; i < 4; ++i) turns[i] = turn(shape, i);
  const auto left = std::ranges::count_if(turns, [](double t) { return t > 0; });
  require(left != 2, "the plate's edges cross; give the corners in order round it");
  const double sense = left > 2 ? 1 : -1;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& at = shape.corners[i];
    require(sense * turns[i] > -1e-6, "corner {} ({}, {}) makes the plate concave; give a convex quadrilateral", i + 1,
            at.x(), at.y());
    require(sense * turns[i] > 1e-6,
            "corner {} ({}, {}) lies on the line of its neighbours: the plate is a triangle; give four corners that "
            "turn",
            i + 1, at.x(), at.y());
  }
}

}  // namespace impulse
