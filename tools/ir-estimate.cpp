#include "impulse/measured/response_estimate.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_output.hpp"
#include "lib/numerics/student_t.hpp"
#include "tools/support/blow_record.hpp"
#include "tools/support/regularisation_option.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace {

using namespace impulse;

struct Request {
  std::vector<std::string> files;
  BlowRecords records;
  EstimateOptions options;
  std::optional<std::string> frequency_response;
  std::optional<std::size_t> resamples;
  std::size_t seed = 1;
  bool members = false;
  bool quiet = false;
  std::string output;

  void declare(Command& command) {
    command.files("RECORD", files, 1, 1000, "CSV files with time_s, a force and a motion, one blow each; - is stdin");
    records.declare(command);
    command.choice<ResponseEstimator>("--estimator", options.estimator,
                                      {{"least-squares", ResponseEstimator::least_squares},
                                       {"h1", ResponseEstimator::h1},
                                       {"h2", ResponseEstimator::h2},
                                       {"hv", ResponseEstimator::hv}},
                                      "causal least squares in time, or an average of spectra");
    declare_regularisation(command, options.regularisation);
    command.quantity("--trigger", options.blow.trigger, "1", Sign::positive,
                     "fraction of the peak force at which a pulse begins and ends");
    command.quantity("--second-hit", options.blow.second_hit, "1", Sign::positive,
                     "fraction of the peak force that counts as a second hit");
    command.quantity("--force-window", options.blow.force_window_s, "s", Sign::positive,
                     "the force is zero so long after the trigger (default: the pulse and half its length)");
    command.choice<BlowFault>("--accept", options.accepted,
                              {{"clipped-force", BlowFault::clipped_force},
                               {"clipped-response", BlowFault::clipped_response},
                               {"second-hit", BlowFault::second_hit}},
                              "faults that do not leave a blow out");
    command.quantity("--exponential-window", options.exponential_s, "s", Sign::positive,
                     "time constant of a window on both channels; the damping that it adds is taken off again");
    command.quantity("--mass", options.free_mass_kg, "kg", Sign::positive,
                     "of a free body: the rigid-body part of the response is 1/mass");
    command.choice<Drift>("--drift", options.drift,
                          {{"none", Drift::none}, {"held", Drift::held}, {"free", Drift::free}},
                          "take a straight line off the velocity, so that it ends at rest, or at impulse/mass");
    command.quantity("--duration", options.duration_s, "s", Sign::positive,
                     "of the response (default: what the shortest record gives)");
    command.text("--frequency-response", frequency_response, "FILE",
                 "write frequency_Hz, the mobility H1 and the coherence to FILE");
    command.count("--bootstrap", resamples, 40,
                  "standard uncertainties from so many resamples of the blows, each estimated anew (default: the limit "
                  "of many, in closed form and to first order)");
    command.count("--seed", seed, 0, "of the resamples");
    command.flag("--members", members,
                 "write the deviation of every blow (or resample) too, from which errors can be drawn");
    command.flag("--quiet", quiet, "do not report on stderr what was chosen");
    command.output(output);
  }
};

void report(const Request& request, const ResponseEstimate& estimate) {
  for (const LeftOut& blow : estimate.left_out)
    fmt::print(stderr, "ir-estimate: {} is left out: {}\n", blow.name, description(blow.fault));
  if (request.quiet) return;
  fmt::print(stderr, "ir-estimate: blows {}; degrees of freedom {}; regularisation {:.3g}{}; force window {:.4g} s\n",
             estimate.blow_count, estimate.measured.degrees_of_freedom, estimate.regularisation,
             rule_name(request.options.regularisation.rule), estimate.force_window_s);
  const auto degrees = static_cast<double>(estimate.measured.degrees_of_freedom);
  if (degrees > 0)
    fmt::print(stderr,
               "ir-estimate: 95 % bands: {:.3f} standard uncertainties for any one sample, {:.3f} for 95 % of the "
               "samples of this test together\n",
               student_t_quantile(0.975, degrees), curve_band_factor(0.95, 0.05, degrees));
}

void write_frequency_response(const std::string& path, const AveragedSpectra& spectra, double step_s) {
  const std::vector<double> coherence = spectra.coherence();
  const double largest = spectra.largest_input_power();
  CsvOutput output(path, {"frequency_Hz", "mobility_real_m_per_Ns", "mobility_imaginary_m_per_Ns", "coherence",
                          "force_power_relative"});
  for (std::size_t k = 0; k < coherence.size(); ++k) {
    const double power = spectra.input_power[k];
    const std::complex<double> mobility = power > 0 ? spectra.cross[k] / power : 0;
    output.row({static_cast<double>(k) / (static_cast<double>(spectra.transform_size) * step_s), mobility.real(),
                mobility.imag(), coherence[k], power / largest});
  }
  output.close();
}

int run(const Request& request, const Command& command) {
  if (command.given("--seed") && !request.resamples)
    throw UsageError("--seed", "belongs to --bootstrap; add it or leave this out");
  EstimateOptions options = request.options;
  if (request.resamples) options.bootstrap = Bootstrap{.resamples = *request.resamples, .seed = request.seed};
  const BlowRecords::Records records = request.records.read(request.files);
  const ResponseEstimate estimate = estimated_response(records.blows, records.step_s, options);
  if (request.members && estimate.measured.deviations.empty())
    throw UsageError("--members", "needs two blows at least; one has no spread");
  report(request, estimate);
  if (request.frequency_response)
    write_frequency_response(*request.frequency_response, estimate.spectra, records.step_s);
  write_measured_response(request.output, estimate.measured, request.members ? Members::yes : Members::no);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command(
      {"ir-estimate", "impulse response of a body from hammer blows",
       "Finds G, H and U such that each recorded velocity is the convolution of G with the recorded force: causal "
       "least "
       "squares in time over all blows, or the average of spectra H1, H2 or Hv. G is in m/s per N s and holds no "
       "factor "
       "of the sampling. Blows that are clipped or hit twice are left out. With two blows or more also the standard "
       "uncertainties impulse_response_std_per_kg, step_velocity_std_m_per_Ns and step_displacement_std_m_per_N, from "
       "the spread of the blows, and their degrees_of_freedom. What was chosen is reported on stderr, and by what the "
       "standard uncertainties are to be multiplied for a 95 % band: Student's t for a band that holds any one sample "
       "in 95 % of tests (in a single test the share of samples within scatters about 95 %, since neighbours err "
       "alike); a larger factor for a band that holds 95 % of the samples of one test in 95 % of tests or more, "
       "however their errors depend on each other. Either tells what differs from blow to blow, nothing else.",
       "printf 'time_s,force_N,velocity_m_per_s\\n' > blow.csv\n"
       "awk 'BEGIN { for (k = 0; k < 400; ++k) { f = k < 20 ? 100*sin(k*3.14159265/20) : 0; v += (f + last)/2*1e-5/2; "
       "last = f; print k*1e-5 \",\" f \",\" v } }' >> blow.csv\n"
       "ir-estimate --regularisation none blow.csv -o two-kilograms.csv"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return run(request, command); });
}
