#include "fem/bodies/mass_structure.hpp"

#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {

Structure mass_structure(double mass_kg, const std::vector<Face>& faces) {
  require(std::isfinite(mass_kg) && mass_kg > 0, "mass {} kg is not positive", mass_kg);
  require(faces.size() == 1 || (faces.size() == 2 && faces[0] != faces[1]), "a mass has two faces; A, B or both");
  const auto contact_count = static_cast<Eigen::Index>(faces.size());
  Structure body;
  body.stiffness.resize(1, 1);
  body.mass.resize(1, 1);
  body.mass.insert(0, 0) = mass_kg;
  body.contacts = Eigen::MatrixXd::Ones(1, contact_count);
  if (contact_count == 2) body.contacts(0, 1) = -1;
  body.outputs = Eigen::MatrixXd::Zero(1, 0);
  body.wave_admittance = Eigen::MatrixXd::Zero(contact_count, contact_count);
  return body;
}

}  // namespace impulse
