#include "fem/elements/bar_element.hpp"

#include <cmath>
#include <numbers>

namespace impulse {
namespace {

double stiffness_N_per_m(const Segment& element) {
  return element.material.youngs_modulus_Pa * (std::numbers::pi / 4) * element.diameter_a_m * element.diameter_b_m /
         element.length_m;
}

/// ρh(π/4)/6, the mass per squared diameter common to all entries [kg/m²].
double mass_factor(const Segment& element) {
  return element.material.density_kg_per_m3 * element.length_m * std::numbers::pi / 24;
}

}  // namespace

Eigen::Matrix2d bar_element_stiffness(const Segment& element) {
  const double k = stiffness_N_per_m(element);
  Eigen::Matrix2d matrix;
  matrix << k, -k, -k, k;
  return matrix;
}

Eigen::Matrix2d bar_element_consistent_mass(const Segment& element) {
  const double d1 = element.diameter_a_m;
  const double d2 = element.diameter_b_m;
  Eigen::Matrix2d matrix;
  matrix << 2 * d1 * d1, d1 * d2, d1 * d2, 2 * d2 * d2;
  return mass_factor(element) * matrix;
}

Eigen::Vector2d bar_element_lumped_mass(const Segment& element) {
  const double d1 = element.diameter_a_m;
  const double d2 = element.diameter_b_m;
  return mass_factor(element) * Eigen::Vector2d{d1 * (2 * d1 + d2), d2 * (d1 + 2 * d2)};
}

double bar_element_highest_frequency(const Segment& element) {
  const Eigen::Vector2d mass = bar_element_lumped_mass(element);
  return std::sqrt(stiffness_N_per_m(element) * (1 / mass[0] + 1 / mass[1]));
}

}  // namespace impulse
