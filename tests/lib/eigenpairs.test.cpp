#include "lib/numerics/eigenpairs.hpp"

#include "lib/contract/errors.hpp"
#include "tests/support/about.hpp"
#include "tests/support/chain.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

using namespace impulse;
using namespace impulse::test;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double orthonormality_error(const Eigenpairs& pairs, const Eigen::SparseMatrix<double>& m) {
  const Eigen::Index n = pairs.values.size();
  return (pairs.vectors.transpose() * (m * pairs.vectors) - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff();
}

/// max ‖K u - λ M u‖ over the pairs, relative to ‖K‖‖u‖.
double equation_error(const Eigenpairs& pairs, const Pencil& p) {
  const Eigen::MatrixXd error = p.k * pairs.vectors - p.m * pairs.vectors * pairs.values.asDiagonal();
  return (error.colwise().norm().array() / pairs.vectors.colwise().norm().array()).maxCoeff() / p.k.norm();
}

/// q × q grid of unit masses and springs, free: λ = 4 sin²(iπ/2q) + 4 sin²(jπ/2q), most of them double.
Pencil grid(Eigen::Index q) {
  const Eigen::MatrixXd line = chain_stiffness(q, 1, Ends::free);
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(q * q, q * q);
  for (Eigen::Index a = 0; a < q; ++a) {
    k.block(a * q, a * q, q, q) += line;
    for (Eigen::Index b = 0; b < q; ++b) k.block(a * q, b * q, q, q).diagonal().array() += line(a, b);
  }
  return {sparse(k), lumped_mass(q * q, 1)};
}

Eigen::VectorXd grid_values(Eigen::Index q) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < q; ++i)
    for (Eigen::Index j = 0; j < q; ++j)
      values.push_back(std::pow(chain_frequency(i, q, 1, 1, Ends::free), 2) +
                       std::pow(chain_frequency(j, q, 1, 1, Ends::free), 2));
  std::ranges::sort(values);
  return Eigen::Map<Eigen::VectorXd>(values.data(), q * q);
}

}  // namespace

TEST_CASE("eigenpairs: the tridiagonal method gives the chain's closed form, for a few and for all") {
  constexpr Eigen::Index n = 200;
  const Eigen::SparseMatrix<double> k = chain_stiffness(n, 1, Ends::fixed);
  for (const std::size_t count : {1U, 5U, 19U, 20U, 200U}) {
    const Eigenpairs pairs = tridiagonal_eigenpairs(k.diagonal(), Eigen::VectorXd::Constant(n - 1, -1), count);
    REQUIRE(pairs.values.size() == static_cast<Eigen::Index>(count));
    REQUIRE(pairs.vectors.cols() == static_cast<Eigen::Index>(count));
    for (Eigen::Index j = 0; j < pairs.values.size(); ++j)
      CHECK(std::abs(pairs.values(j) - std::pow(chain_frequency(j, n, 1, 1, Ends::fixed), 2)) <= 20 * epsilon * 4);
    const Pencil pencil{k, lumped_mass(n, 1)};
    CHECK(orthonormality_error(pairs, pencil.m) <= 1e-12);
    CHECK(equation_error(pairs, pencil) <= 20 * epsilon);
  }
  CHECK(tridiagonal_eigenpairs(Eigen::VectorXd::Constant(1, 3), Eigen::VectorXd(0), 1).values(0) == 3);
}

TEST_CASE("eigenpairs: the dense method gives the consistent bar's closed form, for a few and for all") {
  constexpr Eigen::Index elements = 60;
  const Pencil bar = consistent_bar(elements, 3, 0.2);
  for (const std::size_t count : {1U, 7U, 15U, 16U, 61U}) {
    const Eigenpairs pairs = dense_eigenpairs(Eigen::MatrixXd(bar.k), Eigen::MatrixXd(bar.m), count);
    REQUIRE(pairs.values.size() == static_cast<Eigen::Index>(count));
    REQUIRE(pairs.vectors.cols() == static_cast<Eigen::Index>(count));
    const double top = 12 * 3 / 0.2;
    for (Eigen::Index j = 0; j < pairs.values.size(); ++j) {
      const double cosine = std::cos(static_cast<double>(j) * std::numbers::pi / static_cast<double>(elements));
      CHECK(std::abs(pairs.values(j) - 6 * 3 / 0.2 * (1 - cosine) / (2 + cosine)) <= 20 * epsilon * top);
    }
    CHECK(orthonormality_error(pairs, bar.m) <= 1e-13);
    CHECK(equation_error(pairs, bar) <= 20 * epsilon);
  }
}

TEST_CASE("eigenpairs: the dense method reads the lower triangles") {
  const Pencil bar = consistent_bar(20, 3, 0.2);
  Eigen::MatrixXd k(bar.k), m(bar.m);
  k.triangularView<Eigen::StrictlyUpper>().setConstant(7);
  m.triangularView<Eigen::StrictlyUpper>().setConstant(7);
  for (const std::size_t count : {3U, 21U}) CHECK(equation_error(dense_eigenpairs(k, m, count), bar) <= 20 * epsilon);
}

TEST_CASE("eigenpairs: shift-invert finds every multiple eigenvalue") {
  constexpr Eigen::Index q = 12;
  const Pencil plate = grid(q);
  const Eigen::VectorXd exact = grid_values(q);
  // 2 and 4 cut through a double eigenvalue.
  for (const std::size_t count : {1U, 2U, 3U, 4U, 8U, 40U, 100U, 143U}) {
    CAPTURE(count);
    const Eigenpairs pairs = shift_invert_eigenpairs(plate.k, plate.m, count, -0.05);
    REQUIRE(pairs.values.size() == static_cast<Eigen::Index>(count));
    CHECK((pairs.values - exact.head(pairs.values.size())).cwiseAbs().maxCoeff() <= 1e-12);
    CHECK(orthonormality_error(pairs, plate.m) <= 1e-11);
    CHECK(equation_error(pairs, plate) <= 1e-12);
  }
}

TEST_CASE("eigenpairs: shift-invert finds eigenvalues of high multiplicity") {
  // Five equal chains side by side: every eigenvalue fivefold, of which a Krylov space shows one.
  constexpr Eigen::Index n = 30;
  Pencil chains{chain_stiffness(n, 1, Ends::fixed), lumped_mass(n, 2)};
  for (int i = 1; i < 5; ++i)
    chains = {side_by_side(chains.k, chain_stiffness(n, 1, Ends::fixed)), side_by_side(chains.m, lumped_mass(n, 2))};
  for (const std::size_t count : {3U, 5U, 12U, 20U}) {
    CAPTURE(count);
    const Eigenpairs pairs = shift_invert_eigenpairs(chains.k, chains.m, count, -0.01);
    for (Eigen::Index i = 0; i < pairs.values.size(); ++i)
      CHECK(pairs.values(i) == about(std::pow(chain_frequency(i / 5, n, 1, 2, Ends::fixed), 2)).epsilon(1e-11));
    CHECK(orthonormality_error(pairs, chains.m) <= 1e-11);
  }
}

TEST_CASE("eigenpairs: shift-invert finds the multiple eigenvalues that ARPACK alone passes over") {
  // Values 1, 2, 3, ..., each five or ten times: ARPACK converges before rounding shows it all of the copies.
  constexpr Eigen::Index n = 400;
  for (const auto& [multiplicity, count] : {std::pair{5, 5U}, {10, 12U}}) {
    CAPTURE(multiplicity);
    const Eigen::VectorXd exact = Eigen::VectorXd::NullaryExpr(
        n, [copies = multiplicity](Eigen::Index i) { return 1 + static_cast<double>(i / copies); });
    const Eigenpairs pairs =
        shift_invert_eigenpairs(sparse(exact.asDiagonal().toDenseMatrix()), lumped_mass(n, 1), count, -0.5);
    CHECK((pairs.values - exact.head(count)).cwiseAbs().maxCoeff() <= 1e-12);
    CHECK(orthonormality_error(pairs, lumped_mass(n, 1)) <= 1e-12);
  }
}

TEST_CASE("eigenpairs: shift-invert gives those above the shift, and none below it") {
  constexpr Eigen::Index q = 10;
  const Pencil plate = grid(q);
  const Eigen::VectorXd exact = grid_values(q);
  const double shift = (exact(19) + exact(20)) / 2;
  REQUIRE(exact(20) - exact(19) > 1e-3);
  const Eigenpairs pairs = shift_invert_eigenpairs(plate.k, plate.m, 15, shift);
  CHECK((pairs.values - exact.segment(20, 15)).cwiseAbs().maxCoeff() <= 1e-12);
}

TEST_CASE("eigenpairs: work of shift-invert on 20000 degrees of freedom") {
  constexpr Eigen::Index n = 20000;
  const Eigen::SparseMatrix<double> k = chain_stiffness(n, 1, Ends::free);
  const double first = std::pow(chain_frequency(1, n, 1, 1, Ends::free), 2);
  const Eigenpairs pairs = shift_invert_eigenpairs(k, lumped_mass(n, 1), 20, -first);
  CHECK(pairs.solve_count <= 100);
  for (Eigen::Index j = 1; j < 20; ++j)
    CHECK(pairs.values(j) == about(std::pow(chain_frequency(j, n, 1, 1, Ends::free), 2)).epsilon(1e-8));
  CHECK(std::abs(pairs.values(0)) <= 1e-8 * first);
}

TEST_CASE("eigenpairs: the count below x is that of the closed form") {
  constexpr Eigen::Index q = 10;
  const Pencil plate = grid(q);
  const Eigen::VectorXd exact = grid_values(q);
  CHECK(eigenvalue_count_below(plate.k, plate.m, -1e-3) == 0);
  for (Eigen::Index i = 1; i < exact.size(); ++i)
    if (exact(i) - exact(i - 1) > 1e-6)
      CHECK(eigenvalue_count_below(plate.k, plate.m, (exact(i) + exact(i - 1)) / 2) == static_cast<std::size_t>(i));
  CHECK(eigenvalue_count_below(plate.k, plate.m, 9) == 100);
  // A pivot is exactly 0 here: x = 2 is not an eigenvalue of two masses between walls (1, 3), but K_11 - 2 = 0.
  CHECK(eigenvalue_count_below(chain_stiffness(2, 1, Ends::fixed), lumped_mass(2, 1), 2) == 1);
}

TEST_CASE("eigenpairs: the same input gives the same bits") {
  const Pencil bar = consistent_bar(300, 3, 0.2);
  const Eigen::MatrixXd k(bar.k), m(bar.m);
  const Eigenpairs a = dense_eigenpairs(k, m, 301), b = dense_eigenpairs(k, m, 301);
  CHECK(a.values == b.values);
  CHECK(a.vectors == b.vectors);
  const Eigenpairs c = shift_invert_eigenpairs(bar.k, bar.m, 30, -0.01),
                   d = shift_invert_eigenpairs(bar.k, bar.m, 30, -0.01);
  CHECK(c.values == d.values);
  CHECK(c.vectors == d.vectors);
  CHECK(c.solve_count == d.solve_count);
}

TEST_CASE("eigenpairs: none asked for is none") {
  const Pencil bar = consistent_bar(10, 3, 0.2);
  CHECK(dense_eigenpairs(Eigen::MatrixXd(bar.k), Eigen::MatrixXd(bar.m), 0).values.size() == 0);
  CHECK(shift_invert_eigenpairs(bar.k, bar.m, 0, -1).vectors.rows() == 11);
  CHECK(tridiagonal_eigenpairs(Eigen::VectorXd::Ones(3), Eigen::VectorXd::Ones(2), 0).vectors.rows() == 3);
}

TEST_CASE("eigenpairs: refusals") {
  const Eigen::MatrixXd k = Eigen::MatrixXd::Identity(3, 3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS((void)tridiagonal_eigenpairs(Eigen::VectorXd::Ones(3), Eigen::VectorXd::Ones(3), 1),
                       doctest::Contains("has 2 off-diagonal elements, not 3"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)tridiagonal_eigenpairs(Eigen::VectorXd::Ones(3), Eigen::VectorXd::Ones(2), 4),
                       doctest::Contains("ask for at most 3"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)tridiagonal_eigenpairs(Eigen::VectorXd::Constant(3, nan), Eigen::VectorXd::Ones(2), 1),
                       doctest::Contains("not finite"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)dense_eigenpairs(k, Eigen::MatrixXd::Identity(2, 2), 1), doctest::Contains("same size"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)dense_eigenpairs(k, k, 4), doctest::Contains("ask for at most 3"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)dense_eigenpairs(k * nan, k, 1), doctest::Contains("not finite"), std::invalid_argument);
  Eigen::MatrixXd indefinite = Eigen::MatrixXd::Identity(8, 8);
  indefinite(1, 1) = -1;
  for (const std::size_t count : {1U, 8U})
    CHECK_THROWS_WITH_AS((void)dense_eigenpairs(Eigen::MatrixXd::Identity(8, 8), indefinite, count),
                         doctest::Contains("leading minor 2"), std::invalid_argument);
  const Eigen::SparseMatrix<double> s = sparse(k);
  CHECK_THROWS_WITH_AS((void)shift_invert_eigenpairs(s, s, 3, 0), doctest::Contains("use the dense method"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)shift_invert_eigenpairs(s, sparse(Eigen::MatrixXd::Identity(2, 2)), 1, 0),
                       doctest::Contains("same size"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)shift_invert_eigenpairs(s, s, 1, nan), doctest::Contains("not finite"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)shift_invert_eigenpairs(s, s, 1, 2), doctest::Contains("where there are 0"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)shift_invert_eigenpairs(s, s, 1, 1), doctest::Contains("cannot be factorised"),
                       std::invalid_argument);
}

TEST_CASE("eigenpairs: low values of a graded dense problem keep their digits, high ones too") {
  // Blocks d² [1 ½; ½ 1]: ½d² and 3/2 d², with d² from 1 to 1e16. The direct method leaves ε·1e16 in every value.
  const Eigen::Index blocks = 17;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(2 * blocks, 2 * blocks);
  const Eigen::MatrixXd m = Eigen::MatrixXd::Identity(2 * blocks, 2 * blocks);
  std::vector<double> exact;
  for (Eigen::Index i = 0; i < blocks; ++i) {
    const double scale = std::pow(10.0, static_cast<double>(i));
    k.block(2 * i, 2 * i, 2, 2) << scale, scale / 2, scale / 2, scale;
    exact.insert(exact.end(), {scale / 2, 3 * scale / 2});
  }
  for (const std::size_t count : {3u, 10u, 34u}) {
    const Eigenpairs pairs = lowest_dense_eigenpairs(k, m, 1, count);
    REQUIRE(pairs.values.size() == static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < count; ++i)
      CHECK(pairs.values(static_cast<Eigen::Index>(i)) == about(exact[i]).epsilon(1e-11));
  }
  CHECK(lowest_dense_eigenpairs(k, m, 0, 34, 150).values.size() == 6);
  CHECK(lowest_dense_eigenpairs(k, m, 0, 4, 150).values.size() == 4);
  CHECK(lowest_dense_eigenpairs(k, m, 0, 34, 0.1).values.size() == 0);
}

TEST_CASE("eigenpairs: the lowest of a dense problem are the chain's closed form, rigid-body mode included") {
  const Eigen::Index n = 300;
  for (const Ends ends : {Ends::fixed, Ends::free})
    for (const std::size_t count : {7u, 300u}) {
      const Pencil p{chain_stiffness(n, 3, ends), lumped_mass(n, 2)};
      const Eigenpairs pairs = lowest_dense_eigenpairs(Eigen::MatrixXd(p.k), Eigen::MatrixXd(p.m), 1e-3, count);
      for (Eigen::Index i = 0; i < pairs.values.size(); ++i)
        CHECK(std::abs(pairs.values(i) - std::pow(chain_frequency(i, n, 3, 2, ends), 2)) <
              1e-11 * pairs.values(i) + 1e-14);
      CHECK(orthonormality_error(pairs, p.m) < 1e-10);
      CHECK(equation_error(pairs, p) < 1e-12);
    }
  CHECK_THROWS_WITH((void)lowest_dense_eigenpairs(Eigen::MatrixXd(chain_stiffness(5, 1, Ends::free)),
                                                  Eigen::MatrixXd(lumped_mass(5, 1)), -0.1, 2),
                    doctest::Contains("is not positive semidefinite (K + -0.1·M is not positive definite)"));
}
