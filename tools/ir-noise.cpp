#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_output.hpp"
#include "lib/csv/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace impulse;

struct Request {
  std::vector<std::string> files;
  std::string column;
  std::optional<double> signal_to_noise_dB;
  std::optional<double> sigma;
  std::size_t seed = 1;
  double offset = 0;
  double drift_per_s = 0;
  std::optional<double> full_scale;
  std::string output;

  void declare(Command& command) {
    command.files("RECORD", files, 0, 1, "CSV file with time_s");
    command.text("--column", column, "NAME", "column to spoil; the others stay").required();
    command.quantity("--signal-to-noise", signal_to_noise_dB, "1", Sign::any,
                     "decibels by which white noise lies below the column's root mean square where it is not 0");
    command.quantity("--sigma", sigma, "1", Sign::positive, "standard deviation of white noise, in the column's unit");
    command.count("--seed", seed, 0, "of the noise");
    command.quantity("--offset", offset, "1", Sign::any, "added to all samples");
    command.quantity("--drift", drift_per_s, "1", Sign::any, "added per second");
    command.quantity("--full-scale", full_scale, "1", Sign::positive,
                     "values beyond it on either side are clipped to it");
    command.output(output);
  }
};

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  std::size_t count = 0;
  for (double value : values) {
    sum += value * value;
    count += value != 0 ? 1 : 0;
  }
  return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
}

std::vector<double> spoilt(const Request& request, const CsvTable& table) {
  std::vector<double> values = table.column(request.column);
  const std::vector<double>& time = table.column("time_s");
  double sigma = request.sigma.value_or(0);
  if (request.signal_to_noise_dB) sigma = root_mean_square(values) * std::pow(10, -*request.signal_to_noise_dB / 20);
  std::mt19937_64 engine(request.seed);
  std::normal_distribution<double> normal;
  for (std::size_t n = 0; n < values.size(); ++n) {
    values[n] += sigma * normal(engine) + request.offset + request.drift_per_s * (time[n] - time[0]);
    if (request.full_scale) values[n] = std::clamp(values[n], -*request.full_scale, *request.full_scale);
  }
  return values;
}

int run(const Request& request) {
  if (request.signal_to_noise_dB && request.sigma)
    throw UsageError("--sigma", "and --signal-to-noise both give the noise; leave one out");
  const CsvTable table = read_csv(request.files.front());
  const std::vector<double> values = spoilt(request, table);
  std::vector<NamedColumn> columns;
  for (const std::string& name : table.names())
    columns.push_back({name, name == request.column ? std::span<const double>(values) : table.column(name)});
  write_csv(request.output, columns);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command(
      {"ir-noise", "spoil a column of a record as a transducer would",
       "Adds white noise with a seed, offset and drift, and clips, so that what is computed can be tried on "
       "records whose truth is known.",
       "ir-mass --mass 2kg --step 10us --duration 1ms | ir-noise --column step_velocity_m_per_Ns "
       "--signal-to-noise 40 --seed 7"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return run(request); });
}
