#include "fem/reduced_basis/nonlinear_cost.hpp"

#include <limits>

namespace impulse {

NonlinearCost nonlinear_cost(std::size_t nonlinear_vectors, std::size_t elements) {
  const auto n = static_cast<double>(nonlinear_vectors);
  return {nonlinear_vectors <= 40 ? 2.3 * n * (n + 2) * (n + 1) * n / 6 : std::numeric_limits<double>::infinity(),
          5100 * static_cast<double>(elements)};
}

}  // namespace impulse
