#include "impulse/bodies/ritz_plate.hpp"

#include "lib/contract/require.hpp"
#include "lib/numerics/dense_algebra.hpp"
#include "lib/numerics/quadrature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace impulse {
namespace {

/// Columns of an operator.
enum Derivative : Eigen::Index { value, x, y, xx, xy, yy };

/// Rows of the velocities' operator, and of the rotation of an edge.
enum Motion : Eigen::Index { motion_u, motion_v, motion_w, motion_px, motion_py, motion_count };

/// (ξ, η) along an edge, s from -1 to 1.
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

/// Whether the function i of ξ and j of η has a value on an edge: functions 0 and 1 are those of the ends -1 and 1.
bool is_on_edge(Eigen::Index i, Eigen::Index j, std::size_t edge) {
  return edge == 0 ? j == 0 : edge == 1 ? i == 1 : edge == 2 ? j == 1 : i == 0;
}

/// The same of slopes: functions 2 and 3.
bool is_slope_on_edge(Eigen::Index i, Eigen::Index j, std::size_t edge) { return is_on_edge(i - 2, j - 2, edge); }

/// Unit vectors along the edge and normal to it.
struct EdgeAxes {
  Eigen::Vector2d tangent, normal;
};

EdgeAxes edge_axes(const PlateShape& shape, std::size_t edge) {
  const Eigen::Vector2d t = shape.edge(edge).normalized();
  return {t, {t.y(), -t.x()}};
}

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

using Triplets = std::vector<Eigen::Triplet<double>>;

}  // namespace

RitzPlate::RitzPlate(const Plate& plate, std::size_t terms)
    : plate_(plate),
      values_(terms, RitzBasis::Ends::values),
      slopes_(std::max<std::size_t>(terms, 4), RitzBasis::Ends::slopes) {
  require_valid(plate);
  require(plate.theory == Plate::Theory::shear || terms >= 4, "{} terms a side make no thin plate; use at least 4",
          terms);
  hold_edges();
  require(unknown_count() > 0, "the edges hold every term of {} a side; use more", terms);
}

void RitzPlate::hold_edges() {
  const Eigen::Index n = values_.size(), block = n * n;
  const bool thin = plate_.theory == Plate::Theory::thin;
  Triplets entries;
  Eigen::Index unknown = 0;
  const auto keep_vector = [&](Eigen::Index first, Eigen::Index second, const HeldDirections& held) {
    if (held.all()) return;
    if (const auto left = held.left()) {
      entries.emplace_back(first, unknown, left->x());
      entries.emplace_back(second, unknown++, left->y());
    } else {
      entries.emplace_back(first, unknown++, 1);
      entries.emplace_back(second, unknown++, 1);
    }
  };
  const auto held_directions = [&](Eigen::Index i, Eigen::Index j, bool EdgeSupport::*normal,
                                   bool EdgeSupport::*tangential) {
    HeldDirections held;
    for (std::size_t e = 0; e < 4; ++e) {
      if (!is_on_edge(i, j, e)) continue;
      const EdgeAxes axes = edge_axes(plate_.shape, e);
      if (plate_.edges[e].*normal) held.add(axes.normal);
      if (plate_.edges[e].*tangential) held.add(axes.tangent);
    }
    return held;
  };
  Eigen::Index begin = 0;
  if (moves_in_plane(plate_)) {
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        keep_vector(i * n + j, block + i * n + j,
                    held_directions(i, j, &EdgeSupport::normal_displacement, &EdgeSupport::tangential_displacement));
    begin = 2 * block;
  }
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      bool held = false;
      for (std::size_t e = 0; e < 4; ++e) {
        held = held || (plate_.edges[e].deflection && is_on_edge(i, j, e));
        // Where w = 0 along the edge, its slope by the reference coordinate across is all of the normal slope.
        held = held || (thin && plate_.edges[e].normal_rotation && is_slope_on_edge(i, j, e));
      }
      if (!held) entries.emplace_back(begin + i * n + j, unknown++, 1);
    }
  begin += block;
  if (!thin) {
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        keep_vector(begin + i * n + j, begin + block + i * n + j,
                    held_directions(i, j, &EdgeSupport::normal_rotation, &EdgeSupport::tangential_rotation));
    begin += 2 * block;
  }
  free_.resize(begin, unknown);
  free_.setFromTriplets(entries.begin(), entries.end());
}

std::vector<FormField> RitzPlate::fields(Part part) const {
  const bool thin = plate_.theory == Plate::Theory::thin;
  const double c = -plate_.curvature_per_m;
  const Eigen::Index rows = part == Part::velocities ? Eigen::Index{motion_count} : thin ? 6 : 8;
  const auto field = [&](const RitzBasis& basis) {
    return FormField{&basis, Eigen::MatrixXd::Zero(rows, derivative_count)};
  };
  FormField u = field(values_), v = field(values_), w = field(thin ? slopes_ : values_), px = field(values_),
            py = field(values_);
  if (part == Part::velocities) {
    u.operators(motion_u, value) = v.operators(motion_v, value) = w.operators(motion_w, value) = 1;
    px.operators(motion_px, value) = py.operators(motion_py, value) = 1;
    if (thin) {
      w.operators(motion_px, x) = w.operators(motion_py, y) = -1;
      v.operators(motion_py, value) = c;
    }
  } else {
    u.operators(0, x) = u.operators(2, y) = v.operators(1, y) = v.operators(2, x) = 1;
    w.operators(1, value) = c;
    px.operators(3, x) = px.operators(5, y) = py.operators(4, y) = py.operators(5, x) = 1;
    if (thin) {
      w.operators(3, xx) = w.operators(4, yy) = -1;
      w.operators(5, xy) = -2;
      v.operators(4, y) = v.operators(5, x) = c;
    } else {
      v.operators(6, value) = -c;
      w.operators(6, y) = w.operators(7, x) = py.operators(6, value) = px.operators(7, value) = 1;
    }
  }
  std::vector<FormField> result;
  if (moves_in_plane(plate_)) result = {u, v};
  result.push_back(w);
  if (!thin) result.insert(result.end(), {px, py});
  return result;
}

Eigen::MatrixXd RitzPlate::stiffness_weight() const {
  const bool thin = plate_.theory == Plate::Theory::thin;
  const Laminate& l = plate_.laminate;
  Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(thin ? 6 : 8, thin ? 6 : 8);
  weight.topLeftCorner(3, 3) = l.extension;
  weight.block(0, 3, 3, 3) = weight.block(3, 0, 3, 3) = l.coupling;
  weight.block(3, 3, 3, 3) = l.bending;
  if (!thin) weight.bottomRightCorner(2, 2) = plate_.shear_correction * l.transverse_shear;
  return weight;
}

Eigen::MatrixXd RitzPlate::mass_weight() const {
  const Laminate& l = plate_.laminate;
  Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(motion_count, motion_count);
  if (plate_.theory == Plate::Theory::thin) {
    weight.diagonal().head(3).setConstant(l.mass_kg_per_m2);
    return weight;
  }
  weight.diagonal() << l.mass_kg_per_m2, l.mass_kg_per_m2, l.mass_kg_per_m2, l.rotary_inertia_kg, l.rotary_inertia_kg;
  weight(motion_u, motion_px) = weight(motion_px, motion_u) = l.mass_moment_kg_per_m;
  weight(motion_v, motion_py) = weight(motion_py, motion_v) = l.mass_moment_kg_per_m;
  return weight;
}

Eigen::VectorXd RitzPlate::functional(const std::vector<FormField>& fields, Eigen::Index row,
                                      const Eigen::Vector2d& reference) const {
  Eigen::VectorXd result(free_.rows());
  Eigen::Index begin = 0;
  for (const FormField& field : fields) {
    const Eigen::Index size = field.basis->size() * field.basis->size();
    result.segment(begin, size) = field_functional(*field.basis, plate_.shape, reference, field.operators.row(row));
    begin += size;
  }
  return free_.transpose() * result;
}

Eigen::MatrixXd RitzPlate::spring_stiffness() const {
  const std::vector<FormField> motions = fields(Part::velocities);
  const QuadratureRule rule = gauss_legendre(static_cast<std::size_t>(values_.size()));
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(unknown_count(), unknown_count());
  for (std::size_t e = 0; e < 4; ++e) {
    const EdgeSprings& s = plate_.springs[e];
    const EdgeAxes axes = edge_axes(plate_.shape, e);
    Eigen::MatrixXd directions(5, motion_count);
    directions << 0, 0, 1, 0, 0,                      //
        axes.normal.x(), axes.normal.y(), 0, 0, 0,    //
        axes.tangent.x(), axes.tangent.y(), 0, 0, 0,  //
        0, 0, 0, axes.normal.x(), axes.normal.y(),    //
        0, 0, 0, axes.tangent.x(), axes.tangent.y();
    const std::array stiffness{s.deflection_N_per_m2, s.normal_displacement_N_per_m2,
                               s.tangential_displacement_N_per_m2, s.normal_rotation_N, s.tangential_rotation_N};
    const double half_length = plate_.shape.edge(e).norm() / 2;
    for (std::size_t k = 0; k < stiffness.size(); ++k) {
      if (stiffness[k] == 0) continue;
      Eigen::MatrixXd samples(rule.points.size(), unknown_count());
      for (Eigen::Index q = 0; q < rule.points.size(); ++q) {
        const Eigen::Vector2d at = along_edge(e, rule.points(q));
        samples.row(q).setZero();
        for (Eigen::Index m = 0; m < motion_count; ++m)
          if (directions(static_cast<Eigen::Index>(k), m) != 0)
            samples.row(q) += directions(static_cast<Eigen::Index>(k), m) * functional(motions, m, at).transpose();
        samples.row(q) *= std::sqrt(stiffness[k] * rule.weights(q) * half_length);
      }
      add_transposed_product(samples, samples, result);
    }
  }
  return result;
}

DenseStructure RitzPlate::structure() const {
  const auto terms = static_cast<std::size_t>(values_.size());
  const auto of_unknowns = [this](const Eigen::MatrixXd& form) -> Eigen::MatrixXd {
    return free_.transpose() * (form * free_);
  };
  DenseStructure body;
  body.stiffness = of_unknowns(
      tensor_form(fields(Part::strains), stiffness_weight(), plate_.shape, quadrature_points(plate_.shape, terms)));
  body.stiffness += spring_stiffness();
  body.mass = of_unknowns(
      tensor_form(fields(Part::velocities), mass_weight(), plate_.shape, quadrature_points(plate_.shape, terms) + 1));
  body.contacts.resize(unknown_count(), 0);
  return body;
}

Eigen::VectorXd RitzPlate::deflection(const Eigen::Vector2d& reference) const {
  return functional(fields(Part::velocities), motion_w, reference);
}

Eigen::VectorXd RitzPlate::mean_deflection(const Eigen::Vector2d& reference, double radius_m) const {
  require(std::isfinite(radius_m) && radius_m > 0, "the radius {} m of a patch is not positive and finite", radius_m);
  const Eigen::Vector2d centre = plate_.shape.position(reference);
  const double room = plate_.shape.distance_to_boundary(centre);
  require(radius_m <= room,
          "a patch of radius {:.4g} m about x = {:.4g} m, y = {:.4g} m leaves the plate (an edge is {:.4g} m away)",
          radius_m, centre.x(), centre.y(), room);
  // A polynomial of degree 2(n - 1) in x and y is integrated exactly by n points along the radius, of weight r, and 2n
  // round the disc; the inverse of a bilinear map is so smooth over a disc inside that the same rule will do.
  const QuadratureRule rule = gauss_legendre(static_cast<std::size_t>(values_.size()));
  const Eigen::Index turns = 2 * values_.size();
  const std::vector<FormField> motions = fields(Part::velocities);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(unknown_count());
  for (Eigen::Index p = 0; p < rule.points.size(); ++p) {
    const double r = (1 + rule.points(p)) / 2;
    for (Eigen::Index t = 0; t < turns; ++t) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(t) / static_cast<double>(turns);
      const Eigen::Vector2d at = centre + radius_m * r * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      result +=
          rule.weights(p) * r / static_cast<double>(turns) * functional(motions, motion_w, plate_.shape.reference(at));
    }
  }
  return result;
}

Eigen::MatrixXd RitzPlate::strains(const Eigen::Vector2d& reference, double z_m) const {
  require(std::abs(z_m) <= plate_.laminate.thickness_m / 2 * (1 + 1e-9), "z = {} m is outside the plate", z_m);
  const std::vector<FormField> parts = fields(Part::strains);
  Eigen::MatrixXd result(unknown_count(), 3);
  for (Eigen::Index i = 0; i < 3; ++i)
    result.col(i) = functional(parts, i, reference) + z_m * functional(parts, i + 3, reference);
  return result;
}

}  // namespace impulse
