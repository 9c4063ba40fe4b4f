#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"

#include <doctest/doctest.h>

using namespace impulse;

TEST_CASE("InputError leaves out the places it does not have") {
  CHECK(std::string(InputError("a.csv", 3, 2, "empty field").what()) == "a.csv:3:2: empty field");
  CHECK(std::string(InputError("a.csv", 3, 0, "short row").what()) == "a.csv:3: short row");
  CHECK(std::string(InputError("a.csv", 0, 0, "no data").what()) == "a.csv: no data");
  const InputError error("a.csv", 3, 2, "empty field");
  CHECK(error.file == "a.csv");
  CHECK(error.line == 3);
  CHECK(error.column == 2);
}

TEST_CASE("UsageError begins with the flag") {
  CHECK(std::string(UsageError("--speed", "needs a value").what()) == "--speed: needs a value");
}

TEST_CASE("ConvergenceError carries its numbers") {
  const ConvergenceError error("missed", 1e-6, 1e-3, 40);
  CHECK(error.requested == 1e-6);
  CHECK(error.achieved == 1e-3);
  CHECK(error.iterations == 40);
}

TEST_CASE("require throws the formatted message only when broken") {
  CHECK_NOTHROW(require(true, "never {}", 1));
  CHECK_THROWS_WITH_AS(require(false, "step {} s is not {}", 0.5, "positive"), "step 0.5 s is not positive",
                       std::invalid_argument);
}
