#pragma once

#include "lib/model/structure.hpp"

namespace impulse::test {

/// One mass on a spring, and perhaps a dashpot.
inline Structure oscillator(double stiffness, double mass, double dashpot = 0) {
  Structure body;
  body.stiffness.resize(1, 1);
  body.stiffness.insert(0, 0) = stiffness;
  body.mass.resize(1, 1);
  body.mass.insert(0, 0) = mass;
  if (dashpot > 0) body.dashpots = Eigen::VectorXd::Constant(1, dashpot);
  body.contacts = Eigen::MatrixXd::Ones(1, 1);
  return body;
}

}  // namespace impulse::test
