#include "impulse/measured/response_estimate.hpp"

#include "lib/contract/require.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace impulse {
namespace {

struct Selection {
  std::vector<const Blow*> blows;
  std::vector<BlowWindow> windows;
  std::vector<LeftOut> left_out;

  [[nodiscard]] std::size_t shortest() const {
    std::size_t size = blows.front()->force_N.size();
    for (std::size_t b = 0; b < blows.size(); ++b) size = std::min(size, blows[b]->force_N.size() - windows[b].begin);
    return size;
  }
  [[nodiscard]] std::size_t longest_force() const {
    std::size_t size = 0;
    for (const BlowWindow& window : windows) size = std::max(size, window.force_end - window.begin);
    return size;
  }
};

Selection selection(const std::vector<Blow>& blows, double step_s, const EstimateOptions& options) {
  Selection chosen;
  std::string reasons;
  for (const Blow& blow : blows) {
    const BlowWindow window = examined_blow(blow, step_s, options.blow);
    const bool accepted =
        window.fault == BlowFault::none || std::ranges::find(options.accepted, window.fault) != options.accepted.end();
    if (accepted) {
      chosen.blows.push_back(&blow);
      chosen.windows.push_back(window);
    } else {
      chosen.left_out.push_back({blow.name, window.fault});
      reasons += fmt::format("; {}: {}", blow.name, description(window.fault));
    }
  }
  require(!chosen.blows.empty(), "no blow is left to estimate from{}", reasons);
  return chosen;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

std::vector<InputOutput> prepared(const Selection& chosen, std::size_t size, double step_s,
                                  const EstimateOptions& options) {
  std::vector<InputOutput> records;
  for (std::size_t b = 0; b < chosen.blows.size(); ++b) {
    Blow blow = windowed(*chosen.blows[b], chosen.windows[b], size);
    if (options.drift == Drift::held) remove_drift(blow.response, 0);
    if (options.drift == Drift::free)
      remove_drift(blow.response, sum(blow.force_N) * step_s / options.free_mass_kg.value());
    if (options.exponential_s)
      for (std::size_t n = 0; n < size; ++n) {
        const double window = std::exp(-static_cast<double>(n) * step_s / *options.exponential_s);
        blow.force_N[n] *= window;
        blow.response[n] *= window;
      }
    records.push_back({std::move(blow.force_N), std::move(blow.response)});
  }
  return records;
}

void remove_window(EstimatedKernel& kernel, double step_s, double exponential_s) {
  for (std::size_t n = 0; n < kernel.values.size(); ++n) {
    const double inverse = std::exp(static_cast<double>(n) * step_s / exponential_s);
    kernel.values[n] *= inverse;
    for (auto& deviation : kernel.deviations) deviation[n] *= inverse;
  }
}

double chosen_regularisation(const Regularisation& regularisation, const AveragedSpectra& spectra) {
  switch (regularisation.rule) {
    case Regularisation::Rule::cross_validation:
      return cross_validated_regularisation(spectra);
    case Regularisation::Rule::l_curve:
      return l_curve_regularisation(spectra);
    case Regularisation::Rule::value:
      return regularisation.value;
    case Regularisation::Rule::none:
      break;
  }
  return 0;
}

SpectralEstimator spectral(ResponseEstimator estimator) {
  return estimator == ResponseEstimator::h1   ? SpectralEstimator::h1
         : estimator == ResponseEstimator::h2 ? SpectralEstimator::h2
                                              : SpectralEstimator::hv;
}

void require_consistent(const EstimateOptions& options) {
  const bool unregularised = options.regularisation.rule == Regularisation::Rule::none;
  require(options.drift != Drift::free || options.free_mass_kg, "the drift of a free body needs its mass");
  require(!(options.free_mass_kg && options.drift != Drift::free && unregularised) &&
              !(options.free_mass_kg && options.estimator != ResponseEstimator::least_squares &&
                options.drift != Drift::free),
          "a mass constrains regularised least squares only (or the drift of a free body)");
  require(!options.exponential_s || *options.exponential_s > 0, "the time constant {} s of a window is not positive",
          options.exponential_s.value_or(0));
}

EstimatedKernel estimated_kernel(std::span<const InputOutput> records, const AveragedSpectra& spectra,
                                 double regularisation, double step_s, const EstimateOptions& options,
                                 Deviations deviations) {
  if (options.estimator != ResponseEstimator::least_squares)
    return spectral_kernel(deviations == Deviations::none ? std::span<const InputOutput>() : records, spectra,
                           spectral(options.estimator), regularisation);
  if (options.regularisation.rule == Regularisation::Rule::none) return divided_kernel(records);
  KernelOptions how{.regularisation = regularisation, .deviations = deviations};
  LinearConstraint constraint;
  if (options.free_mass_kg) {
    const std::size_t size = records.front().input.size();
    constraint = rigid_body_constraint(*options.free_mass_kg, size, step_s);
    if (options.exponential_s)
      for (std::size_t n = 0; n < size; ++n)
        constraint.weight[n] *= std::exp(static_cast<double>(n) * step_s / *options.exponential_s);
    how.constraint = &constraint;
  }
  return least_squares_kernel(records, how);
}

EstimatedKernel resampled_kernel(std::span<const InputOutput> records, const AveragedSpectra& spectra,
                                 double regularisation, double step_s, const EstimateOptions& options) {
  EstimatedKernel kernel = estimated_kernel(records, spectra, regularisation, step_s, options, Deviations::none);
  const double lambda = regularisation * spectra.largest_input_power();
  kernel.deviations = bootstrap_deviations(records, *options.bootstrap, [&](std::span<const InputOutput> resample) {
    const AveragedSpectra drawn = averaged_spectra(resample);
    return estimated_kernel(resample, drawn, lambda / drawn.largest_input_power(), step_s, options, Deviations::none)
        .values;
  });
  kernel.values.resize(std::min(kernel.values.size(), kernel.deviations.front().size()));
  return kernel;
}

}  // namespace

ResponseEstimate estimated_response(const std::vector<Blow>& blows, double step_s, const EstimateOptions& options) {
  require_consistent(options);
  Selection chosen = selection(blows, step_s, options);
  const std::size_t size = chosen.shortest();
  const std::size_t force_size = chosen.longest_force();
  require(size > force_size + 1, "the force window of {:.4g} s leaves nothing of a record of {:.4g} s after the blow",
          static_cast<double>(force_size) * step_s, static_cast<double>(size) * step_s);
  const std::vector<InputOutput> records = prepared(chosen, size, step_s, options);

  ResponseEstimate estimate;
  estimate.left_out = std::move(chosen.left_out);
  estimate.blow_count = records.size();
  estimate.force_window_s = static_cast<double>(force_size) * step_s;
  estimate.spectra = averaged_spectra(records);
  estimate.regularisation = chosen_regularisation(options.regularisation, estimate.spectra);

  EstimatedKernel kernel = options.bootstrap
                               ? resampled_kernel(records, estimate.spectra, estimate.regularisation, step_s, options)
                               : estimated_kernel(records, estimate.spectra, estimate.regularisation, step_s, options,
                                                  Deviations::closed_form);
  if (options.exponential_s) remove_window(kernel, step_s, *options.exponential_s);

  UniformGrid grid{step_s, std::min(kernel.values.size(), size - force_size)};
  if (options.duration_s) {
    const UniformGrid wanted = grid_over(*options.duration_s, step_s);
    require(wanted.size <= grid.size, "a response of {:.6g} s is asked for, the records give {:.6g} s",
            *options.duration_s, grid.duration_s());
    grid = wanted;
  }
  estimate.measured = measured_response(kernel, grid);
  return estimate;
}

}  // namespace impulse
