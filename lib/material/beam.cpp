#include "lib/material/beam.hpp"

#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {
namespace {

void require_positive(double value, const char* what, const char* unit) {
  require(std::isfinite(value) && value > 0, "beam: {} {} {} is not positive and finite", what, value, unit);
}

bool is_held(BeamSupports supports, double at) {
  switch (supports) {
    case BeamSupports::free:
      return false;
    case BeamSupports::cantilever:
      return at == 0;
    default:
      return at == 0 || at == 1;
  }
}

}  // namespace

double Beam::area_m2() const { return width_m * height_m; }
double Beam::mass_kg() const { return material.density_kg_per_m3 * area_m2() * length_m; }
double Beam::bending_stiffness_Nm2() const {
  return material.youngs_modulus_Pa * width_m * height_m * height_m * height_m / 12;
}
double Beam::slenderness_frequency() const {
  return std::sqrt(bending_stiffness_Nm2() / (material.density_kg_per_m3 * area_m2())) / (length_m * length_m);
}
double Beam::flexibility_m_per_N() const { return length_m * length_m * length_m / bending_stiffness_Nm2(); }

void require_point(BeamSupports supports, double at) {
  require(at >= 0 && at <= 1, "the point at {} of the length lies outside the beam; give a fraction from 0 to 1", at);
  require(!is_held(supports, at),
          "the point at {} of the length is a support (a force there moves nothing, the response is zero); choose a "
          "point between the supports",
          at);
}

void require_valid(const Beam& beam) {
  require_positive(beam.length_m, "length", "m");
  require_positive(beam.width_m, "width", "m");
  require_positive(beam.height_m, "height", "m");
  require_positive(beam.material.youngs_modulus_Pa, "modulus", "Pa");
  require_positive(beam.material.density_kg_per_m3, "density", "kg/m3");
  require(!beam.contacts_at.empty(), "a beam needs at least one point of contact");
  for (const double at : beam.contacts_at) require_point(beam.supports, at);
}

}  // namespace impulse
