#include "impulse/contact/toeplitz_solvers.hpp"

#include "lib/contract/errors.hpp"
#include "tests/support/direct_sums.hpp"

#include <doctest/doctest.h>

using namespace impulse;

TEST_CASE("toeplitz_solvers: marching equals direct substitution and stops where it is told") {
  std::vector<double> w = direct::random_values(1500, 1);
  for (std::size_t k = 0; k < w.size(); ++k) w[k] *= 0.5 / (1 + static_cast<double>(k));
  w[0] = 2;
  const std::vector<double> b = direct::random_values(1500, 2);
  const std::vector<double> expected = direct::toeplitz_solution(w, b);
  CHECK(direct::largest_difference(marched_toeplitz(w, b, [](auto) { return false; }), expected) < 1e-13);
  const std::vector<double> stopped = marched_toeplitz(w, b, [](std::span<const double> x) { return x.size() == 700; });
  CHECK(std::abs(stopped[699] - expected[699]) < 1e-13);
  CHECK(stopped[700] == 0);
  CHECK(direct::largest_difference(series_toeplitz(w, b, 1e-12), expected) < 1e-12);
  CHECK(direct::largest_difference(contour_toeplitz(w, b, 1e-9), expected) < 1e-10);
}

TEST_CASE("toeplitz_solvers: a ringing kernel falls back on marching; a hopeless one is refused by the residual") {
  std::vector<double> w(4096, 0.0);
  w[0] = 1;
  w[1] = -1.006;  // 1/w grows to 4e10
  const std::vector<double> b(4096, 1.0);
  CHECK_THROWS_AS(static_cast<void>(contour_toeplitz(w, b, 1e-9)), ConvergenceError);
  CHECK_THROWS_WITH_AS(static_cast<void>(series_toeplitz(w, b, 1e-30)), doctest::Contains("residual"),
                       ConvergenceError);
}
