#include "tools/support/draw_request.hpp"

#include "lib/contract/errors.hpp"
#include "lib/csv/csv_output.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace impulse {
namespace {

void write_quantities(const std::string& output, const ForceOutcome& estimate, const ForceBand& band) {
  CsvOutput file(output, {"quantity", "estimate", "lower", "median", "upper"});
  const auto row = [&](const char* name, double value, const Quantiles& q) {
    file.row({name, value, q.lower, q.median, q.upper});
  };
  row("peak_force_N", estimate.peak_force_N, band.peak_force_N);
  row("contact_duration_s", estimate.contact_duration_s, band.contact_duration_s);
  row("impulse_Ns", estimate.impulse_Ns, band.impulse_Ns);
  file.close();
}

void write_band(const std::string& output, const UniformGrid& grid, const ForceOutcome& estimate,
                const ForceBand& band) {
  std::vector<double> time, lower, median, upper;
  for (std::size_t n = 0; n < grid.size; ++n) {
    time.push_back(grid.time_s(n));
    lower.push_back(band.force_N[n].lower);
    median.push_back(band.force_N[n].median);
    upper.push_back(band.force_N[n].upper);
  }
  write_csv(output, {{"time_s", time},
                     {"force_N", estimate.force_N},
                     {"force_lower_N", lower},
                     {"force_median_N", median},
                     {"force_upper_N", upper}});
}

}  // namespace

void DrawRequest::declare(Command& command) {
  command.count(
      "--draws", draws_, 40,
      "carry the uncertainty of the responses to the force by so many draws: time_s,force_N,force_lower_N,"
      "force_median_N,force_upper_N, with --summary rows quantity,estimate,lower,median,upper (default: none)");
  command.count("--seed", options_.seed, 0, "of the draws");
  command.quantity("--confidence", options_.confidence, "1", Sign::positive, "share of the draws in the band");
}

void DrawRequest::require_consistent(const Command& command) const {
  for (const char* flag : {"--seed", "--confidence"})
    if (!asked() && command.given(flag)) throw UsageError(flag, "belongs to --draws; add it or leave this out");
  for (const char* flag : {"--contacts", "--mass-1", "--mass-2"})
    if (asked() && command.given(flag))
      throw UsageError(flag, "is for the impact without draws; leave it or --draws out");
}

void DrawRequest::run(const StruckBodies& bodies, const std::function<ForceOutcome(const StruckBodies&)>& outcome,
                      bool summary, const std::string& output) const {
  if (!bodies.uncertain())
    throw UsageError("--draws", "no response has an uncertainty to draw from (ir-estimate --members writes one)");
  if (bodies.joint_count() > 1) throw UsageError("--draws", "is for one contact; these bodies have several");
  const ForceOutcome estimate = outcome(bodies);
  BandOptions options = options_;
  options.draws = *draws_;
  const ForceBand band = force_band(options, [&](std::mt19937_64& engine) { return outcome(bodies.drawn(engine)); });
  if (band.in_contact_at_end > 0 || estimate.in_contact_at_end)
    fmt::print(stderr,
               "ir-impact: the responses end during contact, after {:g} s, in {} of {} draws{}; compute them with a "
               "longer --duration\n",
               bodies.grid().duration_s(), band.in_contact_at_end, options.draws,
               estimate.in_contact_at_end ? " and by the estimate" : "");
  if (summary)
    write_quantities(output, estimate, band);
  else
    write_band(output, bodies.grid(), estimate, band);
}

}  // namespace impulse
