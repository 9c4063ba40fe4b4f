#include "fem/bodies/mass_structure.hpp"

#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {

Structure mass_structure(double mass_kg) {
  require(std::isfinite(mass_kg) && mass_kg > 0, "mass {} kg is not positive", mass_kg);
  Structure body;
  body.stiffness.resize(1, 1);
  body.mass.resize(1, 1);
  body.mass.insert(0, 0) = mass_kg;
  body.contacts = Eigen::MatrixXd::Ones(1, 1);
  body.outputs = Eigen::MatrixXd::Zero(1, 0);
  body.wave_admittance = Eigen::MatrixXd::Zero(1, 1);
  return body;
}

}  // namespace impulse
