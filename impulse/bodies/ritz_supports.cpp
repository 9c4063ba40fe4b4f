#include "impulse/bodies/ritz_supports.hpp"

#include "impulse/bodies/plate_kinematics.hpp"

#include <cmath>
#include <optional>
#include <vector>

namespace impulse {
namespace {

/// Whether the function i of ξ and j of η has a value on an edge: functions 0 and 1 are those of the ends -1 and 1.
bool is_on_edge(Eigen::Index i, Eigen::Index j, std::size_t edge) {
  return edge == 0 ? j == 0 : edge == 1 ? i == 1 : edge == 2 ? j == 1 : i == 0;
}

/// The same of slopes: functions 2 and 3.
bool is_slope_on_edge(Eigen::Index i, Eigen::Index j, std::size_t edge) { return is_on_edge(i - 2, j - 2, edge); }

/// Directions in which a vector field is held, at most two of them.
class HeldDirections {
 public:
  void add(const Eigen::Vector2d& direction) {
    if (!first_) {
      first_ = direction;
    } else if (std::abs(first_->x() * direction.y() - first_->y() * direction.x()) > 1e-9) {
      all_ = true;
    }
  }
  [[nodiscard]] bool all() const { return all_; }
  /// The direction that is left, if one is held.
  [[nodiscard]] std::optional<Eigen::Vector2d> left() const {
    if (!first_) return std::nullopt;
    return Eigen::Vector2d(-first_->y(), first_->x());
  }

 private:
  std::optional<Eigen::Vector2d> first_;
  bool all_ = false;
};

/// A matrix that grows column by column.
class Columns {
 public:
  void add(Eigen::Index row) { add(row, 1, row, 0); }
  void add(Eigen::Index first, double x, Eigen::Index second, double y) {
    entries_.emplace_back(first, count_, x);
    if (y != 0) entries_.emplace_back(second, count_, y);
    ++count_;
  }
  [[nodiscard]] Eigen::SparseMatrix<double> matrix(Eigen::Index rows) const {
    Eigen::SparseMatrix<double> result(rows, count_);
    result.setFromTriplets(entries_.begin(), entries_.end());
    return result;
  }

 private:
  Eigen::Index count_ = 0;
  std::vector<Eigen::Triplet<double>> entries_;
};

/// Unit vectors along an edge and normal to it.
struct EdgeAxes {
  Eigen::Vector2d tangent, normal;
};

EdgeAxes edge_axes(const PlateShape& shape, std::size_t edge) {
  const Eigen::Vector2d t = shape.edge(edge).normalized();
  return {t, {t.y(), -t.x()}};
}

/// Gathers coefficients, series after series.
class SupportsOfSeries {
 public:
  SupportsOfSeries(const Plate& plate, Eigen::Index n) : plate_(plate), n_(n) {}

  void add_vector(bool HeldEdge::*normal, bool HeldEdge::*tangential) {
    const Eigen::Index block = n_ * n_;
    for (Eigen::Index i = 0; i < n_; ++i)
      for (Eigen::Index j = 0; j < n_; ++j) {
        const Eigen::Index first = begin_ + i * n_ + j, second = first + block;
        const HeldDirections held = held_directions(i, j, normal, tangential);
        if (const auto left = held.left(); left && !held.all()) {
          unheld_.add(first, left->x(), second, left->y());
          held_.add(first, -left->y(), second, left->x());
        } else {
          (held.all() ? held_ : unheld_).add(first);
          (held.all() ? held_ : unheld_).add(second);
        }
      }
    begin_ += 2 * block;
  }

  void add_deflection() {
    for (Eigen::Index i = 0; i < n_; ++i)
      for (Eigen::Index j = 0; j < n_; ++j) (holds_deflection(i, j) ? held_ : unheld_).add(begin_ + i * n_ + j);
    begin_ += n_ * n_;
  }

  [[nodiscard]] SeriesSupports matrices() const { return {unheld_.matrix(begin_), held_.matrix(begin_)}; }

 private:
  [[nodiscard]] HeldDirections held_directions(Eigen::Index i, Eigen::Index j, bool HeldEdge::*normal,
                                               bool HeldEdge::*tangential) const {
    HeldDirections held;
    for (std::size_t e = 0; e < 4; ++e) {
      if (!is_on_edge(i, j, e)) continue;
      const EdgeAxes axes = edge_axes(plate_.shape, e);
      if (plate_.edges[e].*normal) held.add(axes.normal);
      if (plate_.edges[e].*tangential) held.add(axes.tangent);
    }
    return held;
  }

  [[nodiscard]] bool holds_deflection(Eigen::Index i, Eigen::Index j) const {
    const bool thin = plate_.theory == Plate::Theory::thin;
    for (std::size_t e = 0; e < 4; ++e) {
      if (plate_.edges[e].deflection && is_on_edge(i, j, e)) return true;
      // Where w = 0 along the edge, its slope by the reference coordinate across is all of the normal slope.
      if (thin && plate_.edges[e].normal_rotation && is_slope_on_edge(i, j, e)) return true;
    }
    return false;
  }

  const Plate& plate_;
  Eigen::Index n_, begin_ = 0;
  Columns unheld_, held_;
};

}  // namespace

Eigen::Vector2d along_edge(std::size_t edge, double s) {
  switch (edge) {
    case 0:
      return {s, -1};
    case 1:
      return {1, s};
    case 2:
      return {-s, 1};
    default:
      return {-1, -s};
  }
}

Eigen::Matrix<double, 5, 5> edge_motions(const PlateShape& shape, std::size_t edge) {
  const EdgeAxes axes = edge_axes(shape, edge);
  Eigen::Matrix<double, 5, 5> rows = Eigen::Matrix<double, 5, 5>::Zero();
  rows(0, motion_w) = 1;
  rows.block<1, 2>(1, motion_u) = rows.block<1, 2>(3, motion_px) = axes.normal.transpose();
  rows.block<1, 2>(2, motion_u) = rows.block<1, 2>(4, motion_px) = axes.tangent.transpose();
  return rows;
}

std::array<bool, 5> held_motions(const HeldEdge& edge) {
  return {edge.deflection, edge.normal_displacement, edge.tangential_displacement, edge.normal_rotation,
          edge.tangential_rotation};
}

std::array<double, 5> spring_stiffness(const EdgeSprings& edge) {
  return {edge.deflection_N_per_m2, edge.normal_displacement_N_per_m2, edge.tangential_displacement_N_per_m2,
          edge.normal_rotation_N, edge.tangential_rotation_N};
}

SeriesSupports series_supports(const Plate& plate, Eigen::Index n) {
  SupportsOfSeries supports(plate, n);
  if (moves_in_plane(plate)) supports.add_vector(&HeldEdge::normal_displacement, &HeldEdge::tangential_displacement);
  supports.add_deflection();
  if (plate.theory == Plate::Theory::shear)
    supports.add_vector(&HeldEdge::normal_rotation, &HeldEdge::tangential_rotation);
  return supports.matrices();
}

}  // namespace impulse
