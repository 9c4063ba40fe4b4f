#pragma once

#include <Eigen/Dense>

namespace impulse {

/// y + A x by the widest vector registers of this machine's processor, up to 8 numbers at a time in place of the two
/// that every processor has. Sums go by columns; those of 8 and of 12 rows, which a dozen finite vectors have, by every
/// fourth column. Gains where A is in the nearest cache; a large A is limited by what the cache delivers (3 µs for 20 ×
/// 1540). Precondition: sizes fit. Verified by: tests/fem/quartic_energy.test.cpp
void add_product(const Eigen::MatrixXd& a, const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> y);

}  // namespace impulse
