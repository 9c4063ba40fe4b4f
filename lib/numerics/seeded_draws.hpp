#pragma once

#include <cstddef>
#include <functional>
#include <random>

namespace impulse {

/// Calls draw(k, engine) for every k < count, each with an engine of its own that is seeded by (seed, k), so that
/// results do not depend on what runs when, nor on how many threads share the work (0: one for each processor).
/// `draw` must bear being called from several threads.
/// @throws what `draw` throws. Verified by: tests/lib/seeded_draws.test.cpp
void for_each_draw(std::size_t count, std::size_t seed, std::size_t threads,
                   const std::function<void(std::size_t, std::mt19937_64&)>& draw);

}  // namespace impulse
