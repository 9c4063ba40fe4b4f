#include "impulse/measured/force_estimate.hpp"

#include "impulse/measured/averaged_spectra.hpp"
#include "impulse/measured/least_squares_kernel.hpp"
#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {
namespace {

std::vector<double> contact_weights(const std::vector<double>& u, std::size_t size, double step_s) {
  std::vector<double> weights(size);
  for (std::size_t k = 0; k < size; ++k) {
    const double here = k == 0 ? 0 : u[k];
    const double before = k <= 1 ? 0 : u[k - 1];
    weights[k] = (u[k + 1] - 2 * here + before) / step_s;
  }
  return weights;
}

/// λ of the rule in units of the squares of samples.
double chosen_lambda(const Regularisation& regularisation, InputOutput record) {
  const auto size = static_cast<double>(record.input.size());
  for (std::size_t n = 0; n < record.input.size(); ++n) {
    const double window = std::exp(-7 * static_cast<double>(n) / size);
    record.input[n] *= window;
    record.output[n] *= window;
  }
  const AveragedSpectra spectra = averaged_spectra({&record, 1});
  const double relative = regularisation.rule == Regularisation::Rule::l_curve
                              ? l_curve_regularisation(spectra, Penalty::slope)
                              : cross_validated_regularisation(spectra, Penalty::slope);
  return relative * spectra.largest_input_power();
}

}  // namespace

ForceEstimate estimated_force(const UniformSeries& velocity, const Response& response,
                              const Regularisation& regularisation) {
  const UniformGrid& grid = velocity.grid;
  require(response.contact_count == 1, "the response has {} contacts; one velocity gives the force at one",
          response.contact_count);
  require(std::abs(response.grid.step_s - grid.step_s) <= 1e-9 * grid.step_s,
          "the response has a step of {:.9g} s, the velocity of {:.9g} s; compute it with the record's --step",
          response.grid.step_s, grid.step_s);
  require(response.grid.size > grid.size,
          "the response lasts {:.6g} s, the velocity {:.6g} s; compute it with a --duration of one step more",
          response.grid.duration_s(), grid.duration_s());
  const std::vector<InputOutput> record{
      {contact_weights(response.pairs.front().step_displacement_m_per_N, grid.size, grid.step_s), velocity.values}};
  if (regularisation.rule == Regularisation::Rule::none) {
    EstimatedKernel kernel = divided_kernel(record);
    kernel.values.resize(grid.size);
    return {std::move(kernel.values), 0};
  }
  double relative = regularisation.value;
  if (regularisation.rule != Regularisation::Rule::value)
    relative = chosen_lambda(regularisation, record.front()) / averaged_spectra(record).largest_input_power();
  return {least_squares_kernel(record, {.regularisation = relative, .penalty = Penalty::slope}).values, relative};
}

}  // namespace impulse
