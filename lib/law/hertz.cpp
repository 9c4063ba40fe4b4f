#include "lib/law/hertz.hpp"

#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {

double contact_modulus_Pa(const Material& material) {
  require(material.poissons_ratio.has_value(),
          "material '{}' has no Poisson's ratio (a contact modulus needs it); add "
          "one, {}:0.3",
          material.name, material.name);
  require(std::isfinite(material.youngs_modulus_Pa) && material.youngs_modulus_Pa > 0,
          "modulus {} Pa of '{}' is not a positive number", material.youngs_modulus_Pa, material.name);
  const double ratio = *material.poissons_ratio;
  return material.youngs_modulus_Pa / (1 - ratio * ratio);
}

double hertz_stiffness(double tip_radius_m, const Material& tip, double target_modulus_Pa) {
  require(std::isfinite(tip_radius_m) && tip_radius_m > 0, "tip radius {} m is not a positive number", tip_radius_m);
  require(std::isfinite(target_modulus_Pa) && target_modulus_Pa > 0, "target modulus {} Pa is not a positive number",
          target_modulus_Pa);
  return 4.0 / 3.0 * std::sqrt(tip_radius_m) / (1 / contact_modulus_Pa(tip) + 1 / target_modulus_Pa);
}

}  // namespace impulse
