#include "impulse/exact/cone_impact.hpp"

#include <cmath>

namespace impulse {

double cone_on_bar_force_N(const Segment& cone, const Segment& bar, double speed_m_per_s, double time_s) {
  const double z1 = cone.impedance_a_kg_per_s();
  const double z2 = bar.impedance_a_kg_per_s();
  const double kappa = cone.material.rod_wave_speed_m_per_s() * (cone.diameter_b_m - cone.diameter_a_m) /
                       (cone.length_m * cone.diameter_a_m);
  return speed_m_per_s * z2 * (1 - z2 / (z1 + z2) * std::exp(-kappa * z1 * time_s / (z1 + z2)));
}

}  // namespace impulse
