#include "lib/numerics/seeded_draws.hpp"

#include <doctest/doctest.h>

#include <set>
#include <stdexcept>
#include <vector>

using namespace impulse;

namespace {

std::vector<std::mt19937_64::result_type> first_numbers(std::size_t count, std::size_t seed, std::size_t threads) {
  std::vector<std::mt19937_64::result_type> numbers(count);
  for_each_draw(count, seed, threads, [&](std::size_t k, std::mt19937_64& engine) { numbers[k] += engine(); });
  return numbers;
}

}  // namespace

TEST_CASE("seeded_draws: every draw once and with numbers of its own, whatever the number of threads") {
  const auto one = first_numbers(101, 7, 1);
  CHECK(std::set(one.begin(), one.end()).size() == 101);
  for (std::size_t threads : {0u, 2u, 3u, 200u}) CHECK(first_numbers(101, 7, threads) == one);
  CHECK(first_numbers(101, 8, 1) != one);
  CHECK(first_numbers(50, 7, 2) == std::vector(one.begin(), one.begin() + 50));
  CHECK(first_numbers(0, 7, 2).empty());
}

TEST_CASE("seeded_draws: an exception of any thread reaches the caller") {
  for (std::size_t wanted : {0u, 1u, 2u})
    CHECK_THROWS_WITH_AS(for_each_draw(40, 1, 3,
                                       [&](std::size_t k, std::mt19937_64&) {
                                         if (k == wanted) throw std::runtime_error("lost");
                                       }),
                         "lost", std::runtime_error);
}
