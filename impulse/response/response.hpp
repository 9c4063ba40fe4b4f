#pragma once

#include "lib/series/uniform_series.hpp"

#include <cstddef>
#include <vector>

namespace impulse {

/// What contact i does after an impulse at contact j, on one grid:
///
///   G [1/kg]      velocity after a unit impulse, without Dirac parts
///   H = ∫G [m/(N s)]  velocity under a unit step force, without the Dirac part that a residual flexibility gives it
///   U = ∫H [m/N]  displacement under a unit step force, complete; U(0+) = R where there is a residual flexibility
///
/// Row 0 holds right limits: H(0+) = 1/Z for a rod.
struct PairResponse {
  std::vector<double> impulse_response_per_kg;
  std::vector<double> step_velocity_m_per_Ns;
  std::vector<double> step_displacement_m_per_N;
};

/// A body as seen from its p contacts. Displacements and forces count in the direction *into* the body at each contact,
/// so that G_ij = G_ji, and a free bar's G_AB tends to -1/m in the mean.
struct Response {
  UniformGrid grid;
  std::size_t contact_count = 1;
  std::vector<PairResponse> pairs;  ///< p·p, row i (where it moves) by column j (where it is struck)

  [[nodiscard]] const PairResponse& pair(std::size_t i, std::size_t j) const { return pairs[i * contact_count + j]; }
  [[nodiscard]] PairResponse& pair(std::size_t i, std::size_t j) { return pairs[i * contact_count + j]; }
};

/// A response of zeros.
[[nodiscard]] Response zero_response(const UniformGrid& grid, std::size_t contact_count);

/// The response of a plane face at `points` points, as plane_face.hpp: one contact, the same for every pair.
/// @throws std::invalid_argument as there; U(0) is the residual flexibility.
[[nodiscard]] Response plane_face(const Response& response, std::size_t points);

/// @throws std::invalid_argument if sizes disagree or a value is not finite.
void require_valid(const Response& response);

}  // namespace impulse
