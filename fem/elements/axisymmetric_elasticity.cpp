#include "fem/elements/axisymmetric_elasticity.hpp"

#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {
namespace {

void require_positive(double value, const char* what) {
  require(std::isfinite(value) && value > 0, "{} {} is not positive and finite", what, value);
}

}  // namespace

double AxisymmetricElasticity::axial_wave_speed_m_per_s() const {
  return std::sqrt(stiffness(2, 2) / density_kg_per_m3);
}

AxisymmetricElasticity isotropic_elasticity(const Material& material) {
  require(material.poissons_ratio.has_value(),
          "material '{}' has no Poisson's ratio, which a solid needs; add it, as in {}:0.3", material.name,
          material.name);
  const double nu = *material.poissons_ratio;
  require(nu > -1 && nu < 0.5, "Poisson's ratio {} of '{}' is outside (-1, 0.5)", nu, material.name);
  const double e = material.youngs_modulus_Pa;
  return transversely_isotropic_elasticity({e, e, nu, nu, e / (2 * (1 + nu)), material.density_kg_per_m3});
}

AxisymmetricElasticity transversely_isotropic_elasticity(const TransverseIsotropy& material) {
  const double ea = material.axial_modulus_Pa, et = material.transverse_modulus_Pa;
  const double va = material.axial_poissons_ratio, vt = material.transverse_poissons_ratio;
  require_positive(ea, "axial modulus");
  require_positive(et, "transverse modulus");
  require_positive(material.axial_shear_modulus_Pa, "axial shear modulus");
  require_positive(material.density_kg_per_m3, "density");
  // Written out rather than inverted, so that isotropic constants come out to rounding even near ν = 0.5.
  const double gap = 1 - vt - 2 * va * va * et / ea;
  require(
      vt > -1 && vt < 1 && gap > 0,
      "Poisson's ratios {} (axial) and {} (transverse) with moduli {} and {} Pa make a material that releases energy "
      "when strained",
      va, vt, ea, et);
  const double across = et / ((1 + vt) * gap);
  Eigen::Matrix4d c = Eigen::Matrix4d::Zero();
  c(0, 0) = c(1, 1) = across * (1 - va * va * et / ea);
  c(0, 1) = c(1, 0) = across * (vt + va * va * et / ea);
  c(0, 2) = c(2, 0) = c(1, 2) = c(2, 1) = et * va / gap;
  c(2, 2) = ea * (1 - vt) / gap;
  c(3, 3) = material.axial_shear_modulus_Pa;
  return {c, material.density_kg_per_m3};
}

}  // namespace impulse
