#include "impulse/measured/force_band.hpp"

#include "impulse/response/response_csv.hpp"
#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/numerics/seeded_draws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace impulse {
namespace {

void add(PairResponse& sum, double factor, const PairResponse& deviation) {
  const auto part = [&](std::vector<double> PairResponse::*member) {
    for (std::size_t n = 0; n < (sum.*member).size(); ++n) (sum.*member)[n] += factor * (deviation.*member)[n];
  };
  part(&PairResponse::impulse_response_per_kg);
  part(&PairResponse::step_velocity_m_per_Ns);
  part(&PairResponse::step_displacement_m_per_N);
}

PairResponse columns(const CsvTable& table, const std::string& kind) {
  return {table.column(fmt::format("impulse_response{}_per_kg", kind)),
          table.column(fmt::format("step_velocity{}_m_per_Ns", kind)),
          table.column(fmt::format("step_displacement{}_m_per_N", kind))};
}

/// The value below which a share p of the sorted values lies, linear between them.
double quantile(const std::vector<double>& sorted, double p) {
  const double at = p * static_cast<double>(sorted.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), sorted.size() - 2);
  return std::lerp(sorted[below], sorted[below + 1], at - static_cast<double>(below));
}

Quantiles quantiles(std::vector<double> values, double confidence) {
  std::ranges::sort(values);
  return {quantile(values, 0.5 - confidence / 2), quantile(values, 0.5), quantile(values, 0.5 + confidence / 2)};
}

}  // namespace

Response drawn_response(const MeasuredResponse& measured, std::mt19937_64& engine) {
  Response drawn = measured.response;
  if (measured.deviations.empty()) return drawn;
  double scale = 1;
  if (measured.degrees_of_freedom > 0) {
    const auto degrees = static_cast<double>(measured.degrees_of_freedom);
    scale = std::sqrt(degrees / std::chi_squared_distribution<double>(degrees)(engine));
  }
  std::normal_distribution<double> normal;
  for (const PairResponse& deviation : measured.deviations) add(drawn.pairs.front(), scale * normal(engine), deviation);
  return drawn;
}

MeasuredResponse measured_response_from(const CsvTable& table, const Response& response) {
  MeasuredResponse measured{response, {}, 0};
  for (std::size_t b = 1; table.has(fmt::format("step_displacement_deviation_{}_m_per_N", b)); ++b)
    measured.deviations.push_back(columns(table, fmt::format("_deviation_{}", b)));
  if (measured.deviations.empty() && table.has("step_displacement_std_m_per_N"))
    measured.deviations.push_back(columns(table, "_std"));
  if (!measured.deviations.empty() && response.contact_count > 1)
    throw InputError(table.file(), 1, 0,
                     fmt::format("has {} contacts and an uncertainty, which is read for one", response.contact_count));
  if (!measured.deviations.empty() && table.has("degrees_of_freedom"))
    measured.degrees_of_freedom = static_cast<std::size_t>(std::max(0.0, table.column("degrees_of_freedom").front()));
  return measured;
}

ForceBand force_band(const BandOptions& options, const std::function<ForceOutcome(std::mt19937_64&)>& outcome) {
  require(options.draws >= 40, "{} draws do not tell a band; use 40 at least", options.draws);
  require(options.confidence > 0 && options.confidence < 1, "the confidence {} is not between 0 and 1",
          options.confidence);
  std::vector<ForceOutcome> outcomes(options.draws);
  for_each_draw(options.draws, options.seed, options.threads,
                [&](std::size_t k, std::mt19937_64& engine) { outcomes[k] = outcome(engine); });

  const auto over_draws = [&](const auto& value) {
    std::vector<double> values;
    for (const ForceOutcome& one : outcomes) values.push_back(value(one));
    return quantiles(std::move(values), options.confidence);
  };
  ForceBand band;
  band.in_contact_at_end = static_cast<std::size_t>(std::ranges::count_if(outcomes, &ForceOutcome::in_contact_at_end));
  for (std::size_t n = 0; n < outcomes.front().force_N.size(); ++n)
    band.force_N.push_back(over_draws([n](const ForceOutcome& one) { return one.force_N[n]; }));
  band.peak_force_N = over_draws([](const ForceOutcome& one) { return one.peak_force_N; });
  band.contact_duration_s = over_draws([](const ForceOutcome& one) { return one.contact_duration_s; });
  band.impulse_Ns = over_draws([](const ForceOutcome& one) { return one.impulse_Ns; });
  return band;
}

}  // namespace impulse
