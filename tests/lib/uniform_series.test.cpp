#include "lib/series/uniform_series.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace impulse;

TEST_CASE("grid_over counts both ends") {
  CHECK(grid_over(3e-4, 1e-4) == UniformGrid{1e-4, 4});
  CHECK(grid_over(1e-3, 1e-5).size == 101);
  CHECK(grid_over(1, 1).size == 2);
  CHECK(grid_over(1.4, 1).size == 2);
  CHECK(grid_over(1.6, 1).size == 3);
  const UniformGrid grid = grid_over(0.5, 0.125);
  CHECK(grid.time_s(3) == 0.375);
  CHECK(grid.duration_s() == 0.5);
  CHECK(UniformGrid{}.duration_s() == 0);
}

TEST_CASE("grid_over refuses steps and durations that make no grid") {
  CHECK_THROWS_WITH_AS((void)grid_over(1, 0), "step 0 s is not positive", std::invalid_argument);
  CHECK_THROWS_WITH((void)grid_over(1, -1), "step -1 s is not positive");
  CHECK_THROWS_WITH((void)grid_over(1, std::nan("")), "step nan s is not positive");
  CHECK_THROWS_WITH((void)grid_over(0.5, 1), "duration 0.5 s is shorter than one step of 1 s; use a shorter step");
  CHECK_THROWS_WITH((void)grid_over(std::numeric_limits<double>::infinity(), 1), doctest::Contains("shorter than"));
  CHECK_THROWS_WITH((void)grid_over(1, 1e-12), doctest::Contains("1e+12 samples (more than 2^25"));
}

TEST_CASE("cumulative_integral is exact for straight lines") {
  const std::vector<double> integral = cumulative_integral({1, 2, 3, 4}, 0.5);
  for (std::size_t k = 0; k < 4; ++k) {
    const double t = 0.5 * static_cast<double>(k);
    CHECK(integral[k] == t + t * t);
  }
  CHECK(cumulative_integral({}, 1).empty());
}

TEST_CASE("cumulative_integral is of order 2") {
  double previous = 0;
  for (const int n : {16, 32, 64, 128, 256}) {
    std::vector<double> values;
    for (int k = 0; k <= n; ++k) values.push_back(std::exp(static_cast<double>(k) / n));
    const double error = std::abs(cumulative_integral(values, 1.0 / n).back() - (std::exp(1.0) - 1));
    if (previous > 0) CHECK(std::log2(previous / error) == about(2).epsilon(0.05));
    previous = error;
  }
}

TEST_CASE("uniform_series: the derivative is exact for parabolas and of order 2") {
  const auto error = [](int n) {
    std::vector<double> x;
    for (int k = 0; k <= n; ++k) x.push_back(std::sin(3.0 * k / n));
    const std::vector<double> slope = derivative(x, 3.0 / n);
    double largest = 0;
    for (int k = 0; k <= n; ++k)
      largest = std::max(largest, std::abs(slope[static_cast<std::size_t>(k)] - std::cos(3.0 * k / n)));
    return largest;
  };
  for (int n : {64, 128, 256, 512}) CHECK(std::abs(std::log2(error(n) / error(2 * n)) - 2) < 0.1);
  const std::vector<double> parabola = derivative({0, 1, 4, 9, 16}, 1);
  for (std::size_t k = 0; k < 5; ++k) CHECK(parabola[k] == about(2.0 * static_cast<double>(k)));
  CHECK_THROWS_WITH_AS((void)derivative({1, 2}, 1), doctest::Contains("three samples"), std::invalid_argument);
}
