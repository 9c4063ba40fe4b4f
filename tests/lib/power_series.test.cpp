#include "lib/transform/power_series.hpp"

#include "tests/support/about.hpp"
#include "tests/support/direct_sums.hpp"

#include <doctest/doctest.h>

using namespace impulse;

namespace {

/// Decaying, so that 1/w is bounded and forward substitution is a fair reference.
std::vector<double> benign_kernel(std::size_t size) {
  std::vector<double> w = direct::random_values(size, 5);
  for (std::size_t k = 0; k < size; ++k) w[k] *= 0.3 * std::exp(-0.5 * static_cast<double>(k));
  w[0] = 1;
  return w;
}

}  // namespace

TEST_CASE("power_series: division equals forward substitution, whatever the length") {
  for (std::size_t size : {1u, 2u, 3u, 4u, 5u, 31u, 64u, 100u, 1000u}) {
    CAPTURE(size);
    const std::vector<double> w = benign_kernel(size);
    const std::vector<double> b = direct::random_values(size, 6);
    const auto result = PowerSeriesDivision(size).divide(b, w, 1e-12);
    CHECK(direct::largest_difference(result.quotient, direct::toeplitz_solution(w, b)) < 1e-13);
    CHECK(result.residual < 1e-13);
    CHECK(result.refinements == 0);
  }
}

TEST_CASE("power_series: 1/(1 - z)^2 has the coefficients n + 1") {
  std::vector<double> w(200, 0.0);
  w[0] = 1;
  w[1] = -2;
  w[2] = 1;
  std::vector<double> b(200, 0.0);
  b[0] = 1;
  const auto result = PowerSeriesDivision(200).divide(b, w, 1e-9);
  for (std::size_t n = 0; n < 200; ++n) CHECK(result.quotient[n] == about(static_cast<double>(n) + 1).epsilon(1e-10));
}

TEST_CASE("power_series: one refinement repairs what a large 1/w loses") {
  // Coefficients of 1/w grow like 1.02^n.
  std::vector<double> w(1024, 0.0);
  w[0] = 1;
  w[1] = -1.02;
  const std::vector<double> b = direct::random_values(1024, 8);
  PowerSeriesDivision division(1024);
  const double plain = division.divide(b, w, HUGE_VAL).residual;
  const auto refined = division.divide(b, w, 0.0);
  CHECK(refined.refinements == 1);
  CHECK(refined.residual <= plain);
}

TEST_CASE("power_series: a quotient that overflows reports an infinite residual, not a small one") {
  std::vector<double> w(1024, 0.0);
  w[0] = 1;
  w[1] = -4;
  const std::vector<double> b(1024, 1.0);
  CHECK(PowerSeriesDivision(1024).divide(b, w, 1e-9).residual > 1e-9);
}

TEST_CASE("power_series: refuses a divisor that starts with 0") {
  CHECK_THROWS_WITH_AS(
      static_cast<void>(PowerSeriesDivision(4).divide(std::vector<double>(4, 1.0), std::vector<double>(4, 0.0), 1)),
      doctest::Contains("first coefficient of the divisor is 0"), std::invalid_argument);
}
