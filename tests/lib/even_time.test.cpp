#include "lib/records/even_time.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <random>
#include <string>

using namespace impulse;

namespace {

EvenTimeFit fit_of_printed(double start, double step, std::size_t size, const char* format) {
  EvenTimeFit fit;
  for (std::size_t k = 0; k < size; ++k) {
    const std::string text = fmt::format(fmt::runtime(format), start + step * static_cast<double>(k));
    fit.add(std::stod(text), printed_half_digit(text));
  }
  return fit;
}

}  // namespace

TEST_CASE("the last digit of a printed number says how well it is known") {
  CHECK(printed_half_digit("-1.98E-04") == about(5e-7));
  CHECK(printed_half_digit("0.00012") == about(5e-6));
  CHECK(printed_half_digit("12") == about(0.5));
  CHECK(printed_half_digit("0,25") == about(0.005));
  CHECK(printed_half_digit("1e+3") == about(500));
  CHECK(printed_half_digit("1E-999") == 0);
}

TEST_CASE("even_time finds the step that was rounded away") {
  for (const double step : {8e-8, 1.0 / 65536, 2e-7, 1.0 / 3000000, 1e-6, 4.1e-9}) {
    CAPTURE(step);
    // Repeated values: the last digit printed is several steps.
    const double start = -2500 * step;
    const std::optional<EvenTime> even = fit_of_printed(start, step, 20000, "{:.2e}").fit();
    REQUIRE(even);
    CHECK(even->step == about(step).epsilon(1e-14));
    CHECK(even->least_step <= step);
    CHECK(even->most_step >= step);
    // Rounding leaves open at most a digit over the whole length, and does: the interval isn't a guess.
    CHECK(even->most_step - even->least_step < 1e-2 * step);
  }
}

TEST_CASE("even_time takes exactly printed values as they are") {
  for (const double step : {1e-7, 1.0 / 44100, 0.25}) {
    const std::optional<EvenTime> even = fit_of_printed(-5 * step, step, 1000, "{}").fit();
    REQUIRE(even);
    CHECK(even->step == about(step).epsilon(1e-14));
    CHECK(even->start == about(-5 * step).epsilon(1e-12));
  }
  CHECK(fit_of_printed(-5e-5, 1e-7, 5000, "{:.8g}").fit()->step == 1e-7);
  CHECK(fit_of_printed(-5e-5, 1e-7, 5000, "{:.8g}").fit()->start == -5e-5);
}

TEST_CASE("even_time refuses what no even step explains") {
  EvenTimeFit bent, jump, back, single;
  for (int k = 0; k < 100000; ++k) {
    bent.add(1e-3 * k + 1e-9 * k * k, 1e-8);
    jump.add(k < 50000 ? 1e-3 * k : 1e-3 * k + 5e-4, 1e-4);
    back.add(-1e-3 * k, 1e-4);
  }
  single.add(1, 0);
  CHECK_FALSE(bent.fit());
  CHECK_FALSE(jump.fit());
  CHECK_FALSE(back.fit());
  CHECK_FALSE(single.fit());
}

TEST_CASE("even_time finds the interval of steps that trying them one by one finds") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> within(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> values, widths;
    EvenTimeFit fit;
    for (int k = 0; k < 30; ++k) {
      widths.push_back(0.2 + 0.1 * within(random));
      values.push_back(3 + 0.7 * k + widths.back() * within(random));
      fit.add(values.back(), widths.back());
    }
    const auto explains = [&](double step) {
      double most = -1e300, least = 1e300;
      for (int k = 0; k < 30; ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        most = std::max(most, values[i] - widths[i] - step * k);
        least = std::min(least, values[i] + widths[i] - step * k);
      }
      return most <= least;
    };
    double least = 1, most = 0;
    for (double step = 0.6; step < 0.8; step += 1e-5)
      if (explains(step)) {
        least = std::min(least, step);
        most = std::max(most, step);
      }
    const std::optional<EvenTime> even = fit.fit();
    REQUIRE(even);
    // The trial steps are 1e-5 apart.
    CHECK(std::abs(even->least_step - least) <= 1.1e-5);
    CHECK(std::abs(even->most_step - most) <= 1.1e-5);
    CHECK(explains(even->step));
  }
}
