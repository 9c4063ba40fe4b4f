#include "lib/numerics/roots.hpp"

#include "lib/contract/errors.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

using impulse::bisected_root;
using impulse::bracketed_root;
using impulse::ConvergenceError;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("roots: both methods find known roots within the tolerance asked for") {
  const auto cosine = [](double x) { return std::cos(x); };
  const auto cubic = [](double x) { return x * x * x - 1e-18; };
  // Root conditioned like 1: the bracket (1e-14 relative) is the error.
  for (const auto root : {bracketed_root, bisected_root}) {
    CHECK(std::abs(root(cosine, 1, 2, {}) - std::numbers::pi / 2) <= 2e-14);
    CHECK(std::abs(root(cubic, 0, 1, {}) - 1e-6) <= 1e-19);
    CHECK(std::abs(root(cosine, 1, 2, {.absolute = 1e-3}) - std::numbers::pi / 2) <= 1e-3);
  }
  CHECK(std::abs(bracketed_root([](double x) { return std::sin(x); }, -1, 2, {.absolute = 1e-12})) <= 1e-12);
}

TEST_CASE("roots: a tolerance below the rounding is met at the rounding") {
  for (const auto root : {bracketed_root, bisected_root}) {
    CHECK(std::abs(root([](double x) { return std::exp(x) - 2; }, 0, 1, {.relative = 0}) - std::numbers::ln2) <=
          8 * std::numeric_limits<double>::epsilon());
    // Never 0, so only the width of the bracket can end the search.
    CHECK(std::abs(root([](double x) { return x < 0.7 ? -1.0 : 1.0; }, 0, 1, {.relative = 0}) - 0.7) <=
          8 * std::numeric_limits<double>::epsilon());
  }
}

TEST_CASE("roots: an end that is a root is the answer") {
  for (const auto root : {bracketed_root, bisected_root}) {
    CHECK(root([](double x) { return x - 1; }, 1, 2, {}) == 1);
    CHECK(root([](double x) { return x - 2; }, 1, 2, {}) == 2);
    CHECK(root([](double x) { return 2 - x; }, 1, 2, {}) == 2);
  }
}

TEST_CASE("roots: work") {
  int count = 0;
  const auto f = [&count](double x) {
    ++count;
    return std::cos(x) - x;
  };
  (void)bracketed_root(f, 0, 1, {});
  CHECK(count <= 15);
  count = 0;
  (void)bisected_root(f, 0, 1, {});
  CHECK(count > 45);  // one bit each: 47 bits for 1e-14
  CHECK(count < 60);
}

TEST_CASE("roots: an exception of the function reaches the caller") {
  struct Custom {
    double x;
  };
  for (const auto root : {bracketed_root, bisected_root}) {
    CHECK_THROWS_AS(root([](double x) -> double { throw Custom{x}; }, 0, 1, {}), Custom);
    int count = 0;
    const auto later = [&count](double x) {
      if (++count > 5) throw Custom{x};
      return std::exp(x) - 2;
    };
    CHECK_THROWS_AS(root(later, 0, 1, {}), Custom);
    CHECK(count == 6);  // nothing is asked of f after it has thrown
  }
}

TEST_CASE("roots: refusals") {
  const auto line = [](double x) { return x - 0.5; };
  for (const auto root : {bracketed_root, bisected_root}) {
    CHECK_THROWS_WITH_AS(root(line, 1, 2, {}), doctest::Contains("same sign"), std::invalid_argument);
    CHECK_THROWS_WITH_AS(root(line, 1, 0, {}), doctest::Contains("not an interval"), std::invalid_argument);
    CHECK_THROWS_WITH_AS(root(line, 0, infinity, {}), doctest::Contains("not an interval"), std::invalid_argument);
    CHECK_THROWS_WITH_AS(root(line, 0, 1, {.absolute = -1}), doctest::Contains("absolute tolerance"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(root(line, 0, 1, {.relative = not_a_number}), doctest::Contains("relative tolerance"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(root(line, 0, 1, {.max_iterations = 0}), doctest::Contains("allow at least one"),
                         std::invalid_argument);
    const auto pole = [](double x) { return x < 0.9 ? -1 : (x < 1 ? not_a_number : 1.0); };
    CHECK_THROWS_WITH_AS(root(pole, 0.8, 1, {}), doctest::Contains("not finite inside"), std::invalid_argument);
    CHECK_THROWS_WITH_AS(root(pole, 0.95, 1, {}), doctest::Contains("at the ends"), std::invalid_argument);
  }
}

TEST_CASE("roots: a missed tolerance is an error that says how far it came") {
  try {
    (void)bisected_root([](double x) { return std::exp(x) - 2; }, 0, 1, {.max_iterations = 10});
    FAIL("no exception");
  } catch (const ConvergenceError& error) {
    CHECK(error.iterations == 10);
    CHECK(error.achieved == std::ldexp(1, -10));
    CHECK(error.requested == impulse::about(1e-14 * std::numbers::ln2).epsilon(0.01));
    CHECK(std::string(error.what()).find("allow more iterations") != std::string::npos);
  }
  CHECK_THROWS_AS((void)bracketed_root([](double x) { return std::exp(x) - 2; }, 0, 1, {.max_iterations = 2}),
                  ConvergenceError);
}
