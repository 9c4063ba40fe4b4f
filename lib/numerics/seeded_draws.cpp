#include "lib/numerics/seeded_draws.hpp"

#include <algorithm>
#include <future>
#include <thread>
#include <vector>

namespace impulse {

void for_each_draw(std::size_t count, std::size_t seed, std::size_t threads,
                   const std::function<void(std::size_t, std::mt19937_64&)>& draw) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  const auto work = [&](std::size_t first) {
    for (std::size_t k = first; k < count; k += threads) {
      std::seed_seq sequence{seed, k};
      std::mt19937_64 engine(sequence);
      draw(k, engine);
    }
  };
  std::vector<std::future<void>> others;
  for (std::size_t thread = 1; thread < std::min(threads, count); ++thread)
    others.push_back(std::async(std::launch::async, work, thread));
  work(0);
  for (std::future<void>& other : others) other.get();
}

}  // namespace impulse
