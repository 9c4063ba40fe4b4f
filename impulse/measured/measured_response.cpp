#include "impulse/measured/measured_response.hpp"

#include "impulse/response/response_csv.hpp"
#include "lib/contract/require.hpp"
#include "lib/csv/csv_output.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace impulse {

PairResponse response_of_kernel(const std::vector<double>& kernel, const UniformGrid& grid) {
  require(grid.size >= 2 && grid.size <= kernel.size(), "a kernel of {} samples does not give a response of {}",
          kernel.size(), grid.size);
  PairResponse pair{std::vector<double>(grid.size), std::vector<double>(grid.size), std::vector<double>(grid.size)};
  double before = 0;
  double mean_velocity = kernel[0];
  for (std::size_t k = 1; k < grid.size; ++k) {
    pair.step_displacement_m_per_N[k] = pair.step_displacement_m_per_N[k - 1] + grid.step_s * mean_velocity;
    before = mean_velocity;
    mean_velocity += kernel[k];
    pair.step_velocity_m_per_Ns[k] = 0.5 * (before + mean_velocity);
    pair.impulse_response_per_kg[k] = kernel[k] / grid.step_s;
  }
  pair.step_velocity_m_per_Ns[0] = kernel[0] - 0.5 * kernel[1];
  pair.impulse_response_per_kg[0] = pair.impulse_response_per_kg[1];
  return pair;
}

MeasuredResponse measured_response(const EstimatedKernel& kernel, const UniformGrid& grid) {
  MeasuredResponse measured{{grid, 1, {response_of_kernel(kernel.values, grid)}}, {}, kernel.degrees_of_freedom};
  for (const std::vector<double>& deviation : kernel.deviations)
    measured.deviations.push_back(response_of_kernel(deviation, grid));
  const bool jumps = measured.response.pairs.front().step_velocity_m_per_Ns[0] > 0.5 * kernel.values[0];
  if (!jumps) {
    measured.response.pairs.front().step_velocity_m_per_Ns[0] = 0;
    for (PairResponse& deviation : measured.deviations) deviation.step_velocity_m_per_Ns[0] = 0;
  }
  return measured;
}

PairResponse MeasuredResponse::standard_uncertainty() const {
  PairResponse sum = zero_response(response.grid, 1).pairs.front();
  const auto add = [&](std::vector<double> PairResponse::*part) {
    std::vector<double>& total = sum.*part;
    for (const PairResponse& deviation : deviations)
      for (std::size_t n = 0; n < total.size(); ++n) total[n] += (deviation.*part)[n] * (deviation.*part)[n];
    for (double& value : total) value = std::sqrt(value);
  };
  add(&PairResponse::impulse_response_per_kg);
  add(&PairResponse::step_velocity_m_per_Ns);
  add(&PairResponse::step_displacement_m_per_N);
  return sum;
}

LinearConstraint rigid_body_constraint(double mass_kg, std::size_t size, double step_s) {
  require(mass_kg > 0, "mass {} kg is not positive", mass_kg);
  LinearConstraint constraint{std::vector<double>(size), 1 / mass_kg};
  // Sample 0 is left out: w_0 is the first half step's weight, not a sample of G.
  double sum = 0;
  for (std::size_t k = 1; k < size; ++k) {
    constraint.weight[k] = std::pow(std::sin(std::numbers::pi * static_cast<double>(k) / static_cast<double>(size)), 2);
    sum += constraint.weight[k];
  }
  for (double& weight : constraint.weight) weight /= sum * step_s;
  return constraint;
}

void write_measured_response(const std::string& path, const MeasuredResponse& measured, Members members) {
  const PairResponse& pair = measured.response.pairs.front();
  const UniformGrid& grid = measured.response.grid;
  std::vector<double> time(grid.size);
  for (std::size_t k = 0; k < time.size(); ++k) time[k] = grid.time_s(k);
  std::vector<NamedColumn> columns{{"time_s", time}};
  const auto add = [&](const PairResponse& values, const std::string& kind) {
    columns.push_back({fmt::format("impulse_response{}_per_kg", kind), values.impulse_response_per_kg});
    columns.push_back({fmt::format("step_velocity{}_m_per_Ns", kind), values.step_velocity_m_per_Ns});
    columns.push_back({fmt::format("step_displacement{}_m_per_N", kind), values.step_displacement_m_per_N});
  };
  add(pair, "");
  PairResponse uncertainty;
  const std::vector<double> degrees(grid.size, static_cast<double>(measured.degrees_of_freedom));
  if (!measured.deviations.empty()) {
    uncertainty = measured.standard_uncertainty();
    add(uncertainty, "_std");
    columns.push_back({"degrees_of_freedom", degrees});
  }
  if (members == Members::yes)
    for (std::size_t b = 0; b < measured.deviations.size(); ++b)
      add(measured.deviations[b], fmt::format("_deviation_{}", b + 1));
  write_csv(path, columns);
}

}  // namespace impulse
