#include "fem/elements/hermite_beam.hpp"

namespace impulse {

Eigen::Matrix4d hermite_beam_stiffness(double bending_stiffness_Nm2, double length_m) {
  const double h = length_m;
  Eigen::Matrix4d k;
  k << 12, 6 * h, -12, 6 * h,               //
      6 * h, 4 * h * h, -6 * h, 2 * h * h,  //
      -12, -6 * h, 12, -6 * h,              //
      6 * h, 2 * h * h, -6 * h, 4 * h * h;
  return bending_stiffness_Nm2 / (h * h * h) * k;
}

Eigen::Matrix4d hermite_beam_consistent_mass(double mass_kg_per_m, double length_m) {
  const double h = length_m;
  Eigen::Matrix4d m;
  m << 156, 22 * h, 54, -13 * h,              //
      22 * h, 4 * h * h, 13 * h, -3 * h * h,  //
      54, 13 * h, 156, -22 * h,               //
      -13 * h, -3 * h * h, -22 * h, 4 * h * h;
  return mass_kg_per_m * h / 420 * m;
}

Eigen::Vector4d hermite_beam_shape(double fraction, double length_m) {
  const double t = fraction;
  const double r = 1 - t;
  return {r * r * (1 + 2 * t), length_m * t * r * r, t * t * (1 + 2 * r), -length_m * t * t * r};
}

}  // namespace impulse
