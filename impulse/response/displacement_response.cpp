#include "impulse/response/displacement_response.hpp"

#include "impulse/contact/step_means.hpp"
#include "lib/contract/require.hpp"

namespace impulse {
namespace {

/// Derivative on the samples; at the last one as over the last step.
std::vector<double> derivative(const std::vector<double>& values, double step_s, double first) {
  std::vector<double> means(values.size() - 1);
  for (std::size_t n = 0; n < means.size(); ++n) means[n] = (values[n + 1] - values[n]) / step_s;
  const double last = means.back();
  return on_samples(means, first, last);
}

}  // namespace

Response displacement_response(const UniformGrid& grid, const std::vector<std::vector<double>>& step_displacement,
                               const Eigen::MatrixXd& wave_admittance) {
  const auto p = static_cast<std::size_t>(wave_admittance.rows());
  require(wave_admittance.cols() == wave_admittance.rows() && step_displacement.size() == p * p,
          "{} displacements for {} x {} pairs", step_displacement.size(), wave_admittance.rows(),
          wave_admittance.cols());
  require(grid.size >= 3, "{} samples are too few for velocities; use three or more", grid.size);
  Response response = zero_response(grid, p);
  for (std::size_t k = 0; k < p * p; ++k) {
    PairResponse& pair = response.pairs[k];
    const std::vector<double>& u = step_displacement[k];
    require(u.size() == grid.size, "a displacement of {} samples on a grid of {}", u.size(), grid.size);
    pair.step_displacement_m_per_N = u;
    pair.step_velocity_m_per_Ns =
        derivative(u, grid.step_s, wave_admittance(static_cast<Eigen::Index>(k / p), static_cast<Eigen::Index>(k % p)));
    const std::vector<double>& h = pair.step_velocity_m_per_Ns;
    pair.impulse_response_per_kg = derivative(h, grid.step_s, (h[1] - h[0]) / grid.step_s);
  }
  require_valid(response);
  return response;
}

}  // namespace impulse
