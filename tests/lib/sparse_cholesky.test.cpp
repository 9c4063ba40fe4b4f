#include "lib/numerics/sparse_cholesky.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace impulse {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// -1, 2, -1 on a grid of side × side points: the five-point Laplacian; its lowest eigenvalue is 8 sin²(π/2(side + 1)).
Eigen::SparseMatrix<double> laplacian(int side, double shift = 0) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const int k = side * i + j;
      entries.emplace_back(k, k, 4 - shift);
      for (const auto& [other, there] : {std::pair{k + 1, j + 1 < side}, std::pair{k + side, i + 1 < side}})
        if (there) {
          entries.emplace_back(k, other, -1);
          entries.emplace_back(other, k, -1);
        }
    }
  Eigen::SparseMatrix<double> a(side * side, side * side);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

TEST_CASE("a definite matrix is solved, one right-hand side or many") {
  for (const int side : {1, 2, 30}) {
    const Eigen::SparseMatrix<double> a = laplacian(side);
    const auto factor = SparseCholesky::of(a);
    REQUIRE(factor.has_value());
    const MatrixXd b = MatrixXd::NullaryExpr(
        a.rows(), 7, [](Eigen::Index i, Eigen::Index j) { return std::sin(static_cast<double>(3 * i + 5 * j)); });
    const MatrixXd x = factor->solve(b);
    // Backward stable: the residual is rounding of |A||x|, and ‖A‖ < 8.
    CHECK((a * x - b).norm() <= 100 * 2.2e-16 * 8 * x.norm());
    const VectorXd alone = factor->solve(VectorXd(b.col(3)));
    CHECK((alone - x.col(3)).norm() <= 1e-13 * alone.norm());
    CHECK((symmetric_solver(a)(VectorXd(b.col(3))) - alone).norm() == 0);
  }
}

TEST_CASE("a free stiffness that factorises by rounding has no answer to a load that moves it") {
  Eigen::MatrixXd chain(3, 3);
  chain << 0.3 + 1e-13, -0.3, 0, -0.3, 1, -0.7, 0, -0.7, 0.7;
  const Eigen::SparseMatrix<double> a = chain.sparseView();
  const auto factor = SparseCholesky::of(a);
  REQUIRE(factor.has_value());
  CHECK_FALSE(answer_of_held(*factor, a, Eigen::Vector3d(1, 0, 0)).has_value());
  const Eigen::SparseMatrix<double> held = laplacian(3);
  const VectorXd b = VectorXd::LinSpaced(9, -1, 2);
  const auto x = answer_of_held(*SparseCholesky::of(held), held, b);
  REQUIRE(x.has_value());
  CHECK((held * *x - b).norm() <= 1e-14 * b.norm());
}

TEST_CASE("an indefinite matrix has no Cholesky factor, but a solver; a singular one has neither") {
  const Eigen::SparseMatrix<double> a = laplacian(12, 1);  // the lowest eigenvalue is 0.116 - 1
  CHECK_FALSE(SparseCholesky::of(a).has_value());
  const VectorXd b = VectorXd::LinSpaced(144, -1, 2);
  const VectorXd x = symmetric_solver(a)(b);
  CHECK((a * x - b).norm() <= 1e-10 * b.norm());
  Eigen::SparseMatrix<double> nothing(3, 3);
  nothing.insert(0, 0) = 1;
  CHECK_FALSE(SparseCholesky::of(nothing).has_value());
  CHECK_FALSE(static_cast<bool>(symmetric_solver(nothing)));
}

TEST_CASE("sizes that do not fit are refused") {
  CHECK_THROWS_WITH((void)SparseCholesky::of(Eigen::SparseMatrix<double>(2, 3)),
                    "a matrix 2 x 3 has no Cholesky factor");
  CHECK_THROWS_WITH((void)SparseCholesky::of(laplacian(2))->solve(VectorXd(VectorXd::Ones(3))),
                    "3 rows do not fit 4 unknowns");
}

}  // namespace
}  // namespace impulse
