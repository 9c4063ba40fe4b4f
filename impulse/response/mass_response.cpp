#include "impulse/response/mass_response.hpp"

#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {

Response mass_response(double mass_kg, const UniformGrid& grid) {
  require(std::isfinite(mass_kg) && mass_kg > 0, "mass {} kg is not positive", mass_kg);
  Response response = zero_response(grid, 1);
  PairResponse& pair = response.pair(0, 0);
  for (std::size_t k = 0; k < grid.size; ++k) {
    const double t = grid.time_s(k);
    pair.impulse_response_per_kg[k] = 1 / mass_kg;
    pair.step_velocity_m_per_Ns[k] = t / mass_kg;
    pair.step_displacement_m_per_N[k] = 0.5 * t * t / mass_kg;
  }
  return response;
}

}  // namespace impulse
