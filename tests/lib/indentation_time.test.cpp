#include "lib/law/indentation_time.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

namespace impulse {
namespace {

TEST_CASE("indentation_time: closed forms of the linear and the 3/2 laws, whatever unloading loses") {
  CHECK(indentation_time_s(ContactLaw::linear(4e8), 0.01, 3) == about(std::sqrt(0.01 / 4e8)).epsilon(1e-11));
  const double m = 8.537e-3, v = 3, k = 1.413e9, hertz = std::pow(1.25 * m * v * v / k, 0.4) / v;
  CHECK(indentation_time_s(ContactLaw::hertz(k), m, v) == about(hertz).epsilon(1e-11));
  CHECK(indentation_time_s(ContactLaw::tan_sun(k, 0.094, 2e-5), m, v) == about(hertz).epsilon(1e-11));
}

TEST_CASE("indentation_time: a table that ends before the striker stops") {
  const ContactLaw table =
      ContactLaw::table({.indentation_m = {0, 1e-5}, .loading_force_N = {0, 100}, .unloading_force_N = {}});
  CHECK(indentation_time_s(table, 1, 2) == about(5e-6));
  CHECK(indentation_time_s(table, 1e-6, 2) == about(std::sqrt(1e-6 / 1e7)).epsilon(1e-9));
}

TEST_CASE("indentation_time: what cannot be asked") {
  CHECK_THROWS_WITH_AS((void)indentation_time_s(ContactLaw::rigid(), 1, 1), "a rigid law has no indentation",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)indentation_time_s(ContactLaw::linear(1), 0, 1), "the striker's mass 0 kg is not positive",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)indentation_time_s(ContactLaw::linear(1), 1, -1),
                       "the striker's speed -1 m/s is not positive", std::invalid_argument);
}

}  // namespace
}  // namespace impulse
