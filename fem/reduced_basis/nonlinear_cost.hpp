#pragma once

#include <cstddef>

namespace impulse {

/// What one nonlinear force costs in a basis, in multiplications of the shell's kernel.
struct NonlinearCost {
  double tensors = 0;  ///< infinite beyond the 40 vectors of quartic_reduction
  double mesh = 0;
};

/// By counting: tensors of n vectors n C(n+2, 3), at 2.3 times the price because they come from the cache and not from
/// registers (3 µs for n = 20, 18 µs for 32); the mesh 5,100 per element (13 µs for 8 × 8).
/// Verified by: tests/fem/nonlinear_cost.test.cpp
[[nodiscard]] NonlinearCost nonlinear_cost(std::size_t nonlinear_vectors, std::size_t elements);

}  // namespace impulse
