#include "impulse/bodies/plate_kinematics.hpp"

namespace impulse {
namespace {

/// Columns of an operator.
enum Derivative : Eigen::Index { value, x, y, xx, xy, yy };

struct PlateOperators {
  FieldOperator u, v, w, px, py;

  explicit PlateOperators(Eigen::Index rows)
      : u(nothing(PlateField::u, rows)),
        v(nothing(PlateField::v, rows)),
        w(nothing(PlateField::w, rows)),
        px(nothing(PlateField::px, rows)),
        py(nothing(PlateField::py, rows)) {}

  static FieldOperator nothing(PlateField field, Eigen::Index rows) {
    return {field, Eigen::MatrixXd::Zero(rows, derivative_count)};
  }

  [[nodiscard]] std::vector<FieldOperator> of(const Plate& plate) const {
    std::vector<FieldOperator> result;
    if (moves_in_plane(plate)) result = {u, v};
    result.push_back(w);
    if (plate.theory == Plate::Theory::shear) result.insert(result.end(), {px, py});
    return result;
  }
};

}  // namespace

std::vector<FieldOperator> strain_operators(const Plate& plate) {
  const bool thin = plate.theory == Plate::Theory::thin;
  const double c = -plate.curvature_per_m;
  PlateOperators e(thin ? 6 : 8);
  e.u.operators(0, x) = e.u.operators(2, y) = e.v.operators(1, y) = e.v.operators(2, x) = 1;
  e.w.operators(1, value) = c;
  if (thin) {
    e.w.operators(3, xx) = e.w.operators(4, yy) = -1;
    e.w.operators(5, xy) = -2;
    e.v.operators(4, y) = e.v.operators(5, x) = c;
  } else {
    e.px.operators(3, x) = e.px.operators(5, y) = e.py.operators(4, y) = e.py.operators(5, x) = 1;
    e.v.operators(6, value) = -c;
    e.w.operators(6, y) = e.w.operators(7, x) = e.py.operators(6, value) = e.px.operators(7, value) = 1;
  }
  return e.of(plate);
}

std::vector<FieldOperator> motion_operators(const Plate& plate) {
  PlateOperators e(motion_count);
  e.u.operators(motion_u, value) = e.v.operators(motion_v, value) = e.w.operators(motion_w, value) = 1;
  e.px.operators(motion_px, value) = e.py.operators(motion_py, value) = 1;
  if (plate.theory == Plate::Theory::thin) {
    e.w.operators(motion_px, x) = e.w.operators(motion_py, y) = -1;
    e.v.operators(motion_py, value) = -plate.curvature_per_m;
  }
  return e.of(plate);
}

Eigen::MatrixXd stiffness_weight(const Plate& plate) {
  const bool thin = plate.theory == Plate::Theory::thin;
  const Laminate& l = plate.laminate;
  Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(thin ? 6 : 8, thin ? 6 : 8);
  weight.topLeftCorner(3, 3) = l.extension;
  weight.block(0, 3, 3, 3) = weight.block(3, 0, 3, 3) = l.coupling;
  weight.block(3, 3, 3, 3) = l.bending;
  if (!thin) weight.bottomRightCorner(2, 2) = plate.shear_correction * l.transverse_shear;
  return weight;
}

Eigen::MatrixXd mass_weight(const Plate& plate) {
  const Laminate& l = plate.laminate;
  Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(motion_count, motion_count);
  if (plate.theory == Plate::Theory::thin) {
    weight.diagonal().head(3).setConstant(l.mass_kg_per_m2);
    return weight;
  }
  weight.diagonal() << l.mass_kg_per_m2, l.mass_kg_per_m2, l.mass_kg_per_m2, l.rotary_inertia_kg, l.rotary_inertia_kg;
  weight(motion_u, motion_px) = weight(motion_px, motion_u) = l.mass_moment_kg_per_m;
  weight(motion_v, motion_py) = weight(motion_py, motion_v) = l.mass_moment_kg_per_m;
  return weight;
}

PlateLoad no_load(const Plate& plate, const Eigen::Vector2d& reference) {
  const Eigen::Index strains = plate.theory == Plate::Theory::thin ? 6 : 8;
  return {reference, Eigen::VectorXd::Zero(strains), Eigen::VectorXd::Zero(motion_count)};
}

PlateLoad motion_load(const Plate& plate, const Eigen::Vector2d& reference, PlateMotionRow row) {
  PlateLoad load = no_load(plate, reference);
  load.forces(row) = 1;
  return load;
}

PlateLoad strain_load(const Plate& plate, const Eigen::Vector2d& reference, Eigen::Index strain, double z_m) {
  PlateLoad load = no_load(plate, reference);
  load.resultants(strain) = 1;
  load.resultants(strain + 3) = z_m;
  return load;
}

}  // namespace impulse
