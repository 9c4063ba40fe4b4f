#pragma once

#include "impulse/measured/response_estimate.hpp"
#include "impulse/response/response.hpp"
#include "lib/series/uniform_series.hpp"

namespace impulse {

/// A force found from what it did.
struct ForceEstimate {
  std::vector<double> force_N;  ///< on the velocity's grid
  double regularisation = 0;    ///< λ over the largest power of the response's weights
};

/// Force on a body of known response from the velocity that it gave the contact, both at rest before: the F that
/// explains v best, by causal least squares with the weights of the contact equation
/// and a penalty on the force's slope,
///
///   v_n = Σ_j w_j F_(n-j),   w_k = (U_(k+1) - 2U_k + U_(k-1))/Δt  (U_0 := 0; least_squares_kernel.hpp)
///
/// λ by a rule is chosen on both signals under a window e^(-7t/T), under which a body that keeps moving comes to rest.
/// Regularisation holds back the frequencies at which the body hardly moves. The last few samples are hardly
/// determined.
/// @throws std::invalid_argument if the response has several contacts, another step, or is shorter than the velocity by
/// more than its last sample; ConvergenceError. Verified by: tests/impulse/force_estimate.test.cpp
[[nodiscard]] ForceEstimate estimated_force(const UniformSeries& velocity_m_per_s, const Response& response,
                                            const Regularisation& regularisation);

}  // namespace impulse
