#pragma once

#include "impulse/measured/least_squares_kernel.hpp"
#include "impulse/response/response.hpp"
#include "lib/csv/csv_table.hpp"

#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// A response with one contact and what is known of its error: G, H and U are linear in the estimated kernel, so its
/// deviations carry over, and their covariance with them.
struct MeasuredResponse {
  Response response;
  std::vector<PairResponse> deviations;  ///< covariance of the response: Σ d dᵀ; none from a single record
  std::size_t degrees_of_freedom = 0;

  /// √(Σ d²), sample by sample. A band of 95 % is student_t_quantile(0.975, degrees_of_freedom) of it to both sides.
  [[nodiscard]] PairResponse standard_uncertainty() const;
};

/// Response of which w_j = kernel_j are the weights of the contact equation, v_n = Σ_j w_j F_(n-j) for a force that is
/// linear over each step and begins at 0 (docs/decisions/0015):
///
///   U_(k+1) = U_k + Δt h_k,  h_k = Σ_(j≤k) w_j (mean of H over step k),  H_k = (h_(k-1) + h_k)/2,  G_k = w_k/Δt,
///
/// so that U is exactly that of the kernel; right limits H_0 = (3h_0 - h_1)/2 and G_0 = G_1, of order 2 in Δt for
/// modes. w is in m/(N s): a velocity per impulse over one step, times the step; no other factor comes from the
/// sampling.
/// @throws std::invalid_argument unless the grid has at least 2 samples and at most as many as the kernel.
/// Verified by: tests/impulse/measured_response.test.cpp
[[nodiscard]] PairResponse response_of_kernel(const std::vector<double>& kernel, const UniformGrid& grid);
/// The same of an estimate with its deviations; H_0 is 0 unless it is more than half of h_0, as where a wave front
/// makes velocity jump: a small H(0+) left by noise would make the first force of a rigid contact, V/H(0+), anything.
[[nodiscard]] MeasuredResponse measured_response(const EstimatedKernel& kernel, const UniformGrid& grid);

/// Σ_k a_k w_k/Δt = 1/m with the weights a of a Hann window over `size` samples: the rigid-body part of G. A mode of
/// frequency f adds at most about 0.06/(fT)³ of its share of G over a record of length T.
/// Verified by: tests/impulse/measured_response.test.cpp
[[nodiscard]] LinearConstraint rigid_body_constraint(double mass_kg, std::size_t size, double step_s);

enum class Members { no, yes };

/// Columns of the response, then `impulse_response_std_per_kg, step_velocity_std_m_per_Ns,
/// step_displacement_std_m_per_N, degrees_of_freedom`; with members also `..._deviation_1_...` and so on, of which the
/// standard uncertainties are the root of the sum of squares. From a single record only the response. @throws
/// OutputError
void write_measured_response(const std::string& path, const MeasuredResponse& response, Members members);

}  // namespace impulse
