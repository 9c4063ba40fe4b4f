#include "lib/numerics/bessel.hpp"
#include "lib/numerics/cubic_spline.hpp"
#include "lib/numerics/student_t.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace impulse;

namespace {

/// Σ (-s/4)^m/(m!(m+n)!)/2^n, summed as it stands: J_n(√s)/√s^n.
double power_series(int n, double s) {
  long double term = n == 0 ? 1.0L : 0.5L;
  long double sum = term;
  for (int m = 1; m < 200; ++m) {
    term *= -static_cast<long double>(s) / 4 / (m * (m + n));
    sum += term;
  }
  return static_cast<double>(sum);
}

}  // namespace

TEST_CASE("bessel: the pair is its power series, on both sides of 0") {
  for (double s : {-400.0, -30.0, -1.0, -1e-3, -1e-9, 0.0, 1e-9, 1e-7, 1e-3, 1.0, 30.0, 100.0}) {
    CAPTURE(s);
    const double scale = s < 0 ? std::exp(-std::sqrt(-s)) : 1;
    const BesselPair pair = scaled_bessel_pair(s);
    // The alternating series loses digits for large s; 1e-14 holds in long double up to s = 100.
    CHECK(std::abs(pair.zeroth - scale * power_series(0, s)) < 1e-14);
    CHECK(std::abs(pair.first - scale * power_series(1, s)) < 1e-14);
  }
  CHECK(std::isfinite(scaled_bessel_pair(-1e12).zeroth));
  CHECK_THROWS_WITH_AS((void)scaled_bessel_pair(std::nan("")), doctest::Contains("no Bessel function"),
                       std::invalid_argument);
}

TEST_CASE("student_t: quantiles in closed form, and the normal limit") {
  // One degree of freedom: tan π(p - ½); two: x/√(2 + x²) = 2p - 1.
  CHECK(student_t_quantile(0.975, 1) == about(std::tan(0.475 * std::numbers::pi)).epsilon(1e-10));
  CHECK(student_t_quantile(0.975, 2) == about(0.95 * std::sqrt(2 / (1 - 0.95 * 0.95))).epsilon(1e-10));
  CHECK(student_t_quantile(0.5, 7) == doctest::Approx(0));
  CHECK(student_t_quantile(0.975, 1e9) == about(1.959963985).epsilon(1e-8));
  CHECK_THROWS_WITH_AS((void)student_t_quantile(1, 4), doctest::Contains("not a probability"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)student_t_quantile(0.9, 0), doctest::Contains("degrees of freedom"),
                       std::invalid_argument);
}

TEST_CASE("curve_band_factor: the share it leaves outside, by counting, for 19 groups of values and for one") {
  // Two degrees of freedom have a distribution in closed form, P(|T| > k) = 1 - k/√(2 + k²); p = 0.05·0.05.
  const double k = curve_band_factor(0.95, 0.05, 2);
  CHECK(1 - k / std::sqrt(2 + k * k) == about(0.0025).epsilon(1e-9));
  // Bonferroni's band of ten values.
  CHECK(curve_band_factor(0.95, 0.1, 4) == about(student_t_quantile(1 - 0.005 / 2, 4)).epsilon(1e-12));
  // 19 errors, each of 1/19 = 5.3 % of the values: 1 - (1 - p)^19 of curves have one beyond, nearly the 5 % allowed.
  CHECK(1 - std::pow(1 - 0.0025, 19) == about(0.0464).epsilon(0.01));
  CHECK_THROWS_WITH_AS((void)curve_band_factor(1, 0.05, 4), doctest::Contains("confidence 1"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)curve_band_factor(0.95, 0, 4), doctest::Contains("share 0"), std::invalid_argument);
}

TEST_CASE("cubic_spline: order 4 inside, exact for lines, refusals") {
  const auto error = [](int n) {
    std::vector<double> x, y;
    for (int k = 0; k <= n; ++k) {
      x.push_back(k * 4.0 / n);
      y.push_back(std::sin(x.back()));
    }
    const CubicSpline spline(x, y);
    double largest = 0;
    for (double at = 1.5; at < 2.5; at += 0.001) largest = std::max(largest, std::abs(spline(at) - std::sin(at)));
    return largest;
  };
  for (int n : {32, 64, 128, 256}) {
    const double slope = std::log2(error(n) / error(2 * n));
    CHECK(std::abs(slope - 4) < 0.1);
  }
  const CubicSpline line({0, 1, 4}, {1, 3, 9});
  CHECK(line(2.5) == about(6));
  CHECK(line.last() == 4);
  CHECK_THROWS_WITH_AS((void)line(4.1), doctest::Contains("outside the spline"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(CubicSpline({0, 1}, {0, 1}), doctest::Contains("three points"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(CubicSpline({0, 1, 1}, {0, 1, 2}), doctest::Contains("ascend"), std::invalid_argument);
}
