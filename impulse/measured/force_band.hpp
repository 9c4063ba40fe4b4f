#pragma once

#include "impulse/measured/measured_response.hpp"

#include <cstddef>
#include <functional>
#include <random>
#include <vector>

namespace impulse {

/// A response drawn from what is known of a measured one:
///
///   G = Ĝ + τ Σ_b z_b d_b,   z_b normal,   τ = √(ν/χ²_ν),
///
/// and H and U with the same numbers: jointly normal, or with ν degrees of freedom jointly Student's, so that quantiles
/// of draws are those of bands by Student's t. Without deviations it is the response itself. Verified by:
/// tests/impulse/force_band.test.cpp
[[nodiscard]] Response drawn_response(const MeasuredResponse& measured, std::mt19937_64& engine);

/// A response file with its uncertainty, if it has any: `..._deviation_1_...` and so on, as ir-estimate --members
/// writes them; or, where there are none, the columns `..._std_...` as a single deviation, i.e. the errors of all
/// samples taken as one number's. `degrees_of_freedom` where it is there (else normal).
/// @throws InputError as response_from, for several contacts with uncertainty, or deviations that miss a column.
[[nodiscard]] MeasuredResponse measured_response_from(const CsvTable& table, const Response& response);

/// What one draw leads to.
struct ForceOutcome {
  std::vector<double> force_N;
  double peak_force_N = 0;
  double contact_duration_s = 0;
  double impulse_Ns = 0;
  bool in_contact_at_end = false;  ///< the responses are too short for it: duration and impulse are what there is
};

struct Quantiles {
  double lower = 0;
  double median = 0;
  double upper = 0;
};

struct ForceBand {
  std::vector<Quantiles> force_N;  ///< sample by sample
  Quantiles peak_force_N;
  Quantiles contact_duration_s;
  Quantiles impulse_Ns;
  std::size_t in_contact_at_end = 0;  ///< how many draws are
};

struct BandOptions {
  std::size_t draws = 0;  ///< ≥ 40
  std::size_t seed = 1;
  double confidence = 0.95;  ///< of the band between lower and upper, in (0, 1)
  std::size_t threads = 0;   ///< 0: one for each processor
};

/// Quantiles of force, peak, duration and impulse over draws, each made by `outcome` with an engine of its own that is
/// seeded by (seed, number of the draw): the same band on any number of threads, which `outcome` must bear.
/// @throws std::invalid_argument for fewer than 40 draws or a confidence outside (0, 1); what `outcome` throws.
/// Verified by: tests/impulse/force_band.test.cpp
[[nodiscard]] ForceBand force_band(const BandOptions& options,
                                   const std::function<ForceOutcome(std::mt19937_64&)>& outcome);

}  // namespace impulse
