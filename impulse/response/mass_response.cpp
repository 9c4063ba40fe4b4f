#include "impulse/response/mass_response.hpp"

#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {

Response mass_response(double mass_kg, const std::vector<Face>& faces, const UniformGrid& grid) {
  require(std::isfinite(mass_kg) && mass_kg > 0, "mass {} kg is not positive", mass_kg);
  require(faces.size() == 1 || (faces.size() == 2 && faces[0] != faces[1]), "a mass has two faces; A, B or both");
  Response response = zero_response(grid, faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = 0; j < faces.size(); ++j) {
      const double mobility = (faces[i] == faces[j] ? 1 : -1) / mass_kg;
      PairResponse& pair = response.pair(i, j);
      for (std::size_t k = 0; k < grid.size; ++k) {
        const double t = grid.time_s(k);
        pair.impulse_response_per_kg[k] = mobility;
        pair.step_velocity_m_per_Ns[k] = t * mobility;
        pair.step_displacement_m_per_N[k] = 0.5 * t * t * mobility;
      }
    }
  return response;
}

Response mass_response(double mass_kg, const UniformGrid& grid) { return mass_response(mass_kg, {Face::a}, grid); }

}  // namespace impulse
