#include "fem/bodies/assembly.hpp"

#include <doctest/doctest.h>

#include <array>
#include <stdexcept>

using namespace impulse;

TEST_CASE("assembly: held degrees of freedom fall out of numbering and matrix, shared ones add up") {
  const std::array<Eigen::Index, 3> held{1, 4, 1};
  const FreeDofs dofs(5, held);
  CHECK(dofs.count() == 3);
  CHECK(dofs[0] == 0);
  CHECK(dofs[1] == FreeDofs::held);
  CHECK(dofs[2] == 1);
  CHECK(dofs[3] == 2);
  MatrixAssembly sum(dofs);
  const Eigen::Matrix3d element{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  sum.add(std::array<Eigen::Index, 3>{3, 1, 0}, element);
  sum.add(std::array<Eigen::Index, 3>{2, 3, 4}, element);
  const Eigen::Matrix3d expected{{9, 0, 7}, {0, 1, 2}, {3, 4, 6}};
  CHECK(Eigen::Matrix3d(sum.matrix()) == expected);
}

TEST_CASE("assembly: refuses to hold what does not exist, or everything") {
  const auto hold = [](Eigen::Index count, std::vector<Eigen::Index> held) { return FreeDofs(count, held); };
  CHECK_THROWS_WITH_AS((void)hold(2, {2}), "degree of freedom 2 is to be held, but there are 2", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)hold(2, {0, 1}), doctest::Contains("every degree of freedom is held"),
                       std::invalid_argument);
}
