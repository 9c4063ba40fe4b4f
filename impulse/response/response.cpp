#include "impulse/response/response.hpp"

#include "lib/contract/require.hpp"
#include "lib/model/plane_face.hpp"

#include <cmath>

namespace impulse {

Response zero_response(const UniformGrid& grid, std::size_t contact_count) {
  const std::vector<double> zeros(grid.size, 0.0);
  return {grid, contact_count, std::vector<PairResponse>(contact_count * contact_count, {zeros, zeros, zeros})};
}

Response plane_face(const Response& response, std::size_t points) {
  require_valid(response);
  require_plane_face(response.contact_count, response.pairs[0].step_displacement_m_per_N[0], points);
  return {response.grid, points, std::vector<PairResponse>(points * points, response.pairs[0])};
}

void require_valid(const Response& response) {
  require(response.pairs.size() == response.contact_count * response.contact_count,
          "a response at {} contacts has {} pairs, not {}", response.contact_count,
          response.contact_count * response.contact_count, response.pairs.size());
  for (const PairResponse& pair : response.pairs)
    for (const auto* values :
         {&pair.impulse_response_per_kg, &pair.step_velocity_m_per_Ns, &pair.step_displacement_m_per_N}) {
      require(values->size() == response.grid.size, "a response on {} samples has a column of {}", response.grid.size,
              values->size());
      for (std::size_t k = 0; k < values->size(); ++k)
        require(std::isfinite((*values)[k]), "a response holds {} at sample {}", (*values)[k], k);
    }
}

}  // namespace impulse
