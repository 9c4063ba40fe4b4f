#include "lib/numerics/dense_algebra.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace impulse;

TEST_CASE("products, solutions and condition numbers of dense matrices") {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(40, 17), b = Eigen::MatrixXd::Random(40, 9);
  Eigen::MatrixXd c = Eigen::MatrixXd::Ones(17, 9);
  add_transposed_product(a, b, c);
  CHECK((c - (a.transpose() * b + Eigen::MatrixXd::Ones(17, 9))).norm() < 1e-14 * 40);
  CHECK_THROWS_WITH(add_transposed_product(a, c, c), doctest::Contains("(40 x 17)ᵀ times 17 x 9 is not 17 x 9"));

  const Eigen::MatrixXd spd = a.transpose() * a + Eigen::MatrixXd::Identity(17, 17);
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(17, 3);
  const auto factor = DenseCholesky::of(spd);
  REQUIRE(factor.has_value());
  CHECK((factor->solve(spd * x) - x).norm() < 1e-13 * x.norm());
  CHECK_FALSE(DenseCholesky::of(-spd).has_value());
  CHECK_THROWS_WITH((void)factor->solve(Eigen::MatrixXd::Zero(3, 1)), "3 rows do not fit 17 unknowns");
  CHECK_THROWS_WITH((void)DenseCholesky::of(a), "a matrix 40 x 17 has no Cholesky factor");

  Eigen::Matrix2d correlated;  // scaled: 1 ± 0.6
  correlated << 1, 600, 600, 1e6;
  CHECK(scaled_condition(correlated) == about(1.6 / 0.4).epsilon(1e-13));
  CHECK_THROWS_WITH((void)scaled_condition(Eigen::Matrix2d::Zero()), doctest::Contains("without a positive diagonal"));
}
