#include "impulse/bodies/ritz_basis.hpp"

#include "lib/numerics/quadrature.hpp"

#include <doctest/doctest.h>

#include <cmath>

using impulse::RitzBasis;

TEST_CASE("functions of the Ritz basis keep their conditions at the ends and diagonalise mass and stiffness") {
  for (const auto ends : {RitzBasis::Ends::values, RitzBasis::Ends::slopes})
    for (const std::size_t size : {4, 5, 12, 30, 60}) {
      CAPTURE(size);
      const RitzBasis basis(size, ends);
      const Eigen::Index held = ends == RitzBasis::Ends::values ? 2 : 4, rest = basis.size() - held;
      const Eigen::Vector2d limits(-1, 1);
      const Eigen::MatrixXd value = basis.at(limits, 0), slope = basis.at(limits, 1);
      CHECK((value.leftCols(2) - Eigen::Matrix2d::Identity()).norm() < 1e-15);
      CHECK(value.rightCols(rest).norm() < 1e-12);
      if (held == 4) {
        CHECK(value.middleCols(2, 2).norm() < 1e-15);
        CHECK(slope.leftCols(2).norm() < 1e-15);
        CHECK((slope.middleCols(2, 2) - Eigen::Matrix2d::Identity()).norm() < 1e-15);
        // A slope is the sum of n² terms that cancel.
        CHECK(slope.rightCols(rest).norm() < 1e-13 * std::pow(static_cast<double>(size), 3));
      }
      const impulse::QuadratureRule rule = impulse::gauss_legendre(size);
      const auto gram = [&](int order) {
        const Eigen::MatrixXd f = basis.at(rule.points, order).rightCols(rest);
        return Eigen::MatrixXd(f.transpose() * rule.weights.asDiagonal() * f);
      };
      // The combinations that vanish at the ends are the less independent the more there are.
      CHECK((gram(0) - Eigen::MatrixXd::Identity(rest, rest)).norm() < 1e-15 * std::pow(static_cast<double>(size), 3));
      const Eigen::MatrixXd stiffness = gram(held == 2 ? 1 : 2);
      CHECK((stiffness - Eigen::MatrixXd(stiffness.diagonal().asDiagonal())).norm() <= 1e-11 * stiffness.norm());
    }
}

TEST_CASE("derivatives of the Ritz basis are those of polynomials") {
  const RitzBasis basis(9, RitzBasis::Ends::values);
  const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(7, -0.9, 0.9);
  const double h = 1e-4;
  const Eigen::VectorXd up = at.array() + h, down = at.array() - h;
  for (const int order : {1, 2}) {
    const Eigen::MatrixXd differences = (basis.at(up, order - 1) - basis.at(down, order - 1)) / (2 * h);
    CHECK((basis.at(at, order) - differences).norm() < 1e-5 * differences.norm());  // error h² times the next but one
  }
}

TEST_CASE("the Ritz basis refuses too few or too many terms") {
  CHECK_THROWS_WITH(RitzBasis(1, RitzBasis::Ends::values), "a series of 1 terms a side is not within 2 to 80");
  CHECK_THROWS_WITH(RitzBasis(3, RitzBasis::Ends::slopes), "a series of 3 terms a side is not within 4 to 80");
  CHECK_THROWS_WITH(RitzBasis(81, RitzBasis::Ends::values), doctest::Contains("81 terms"));
}
