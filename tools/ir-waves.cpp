#include "impulse/measured/bar_waves.hpp"
#include "impulse/measured/blow.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_output.hpp"
#include "lib/csv/csv_table.hpp"
#include "lib/material/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace impulse;

enum class Signal { strain, voltage, force };

struct Request {
  std::vector<std::string> files;
  std::optional<Material> material;
  double diameter_m = 0;
  Signal signal = Signal::strain;
  std::vector<std::string> columns;
  double scale = 1;
  StrainBridge bridge;
  std::optional<double> rest_s;
  Dispersion dispersion = Dispersion::pochhammer_chree;
  std::optional<double> travel_m;
  std::vector<double> gauges_m;
  std::optional<double> split_s;
  std::optional<double> from_s;
  std::optional<double> until_s;
  std::optional<Segment> striker;
  bool summary = false;
  std::string output;

  void declare(Command& command) {
    command.files("RECORD", files, 0, 1, "CSV file with time_s and a column of each gauge");
    command
        .parsed<Material>("--material", material, parse_material, "MATERIAL",
                          "of the bar: a name (steel:0.29) or E:rho:nu, 206GPa:7780kg/m3:0.29; nu for the dispersion")
        .required();
    command.quantity("--diameter", diameter_m, "m", Sign::positive, "of the bar").required();
    command.choice<Signal>("--signal", signal,
                           {{"strain", Signal::strain}, {"voltage", Signal::voltage}, {"force", Signal::force}},
                           "what the columns hold: strain, tension positive; volts of a bridge; newtons, compression "
                           "positive");
    command.text("--column", columns, "NAME", "a gauge's column (default: strain, voltage_V or force_N)");
    command.quantity("--scale", scale, "1", Sign::any, "SI units per unit of the columns, with their sign");
    command.quantity("--gauge-factor", bridge.gauge_factor, "1", Sign::positive, "of the strain gauges");
    command.quantity("--excitation", bridge.excitation_V, "V", Sign::positive, "voltage that feeds the bridge");
    command.quantity("--gain", bridge.gain, "1", Sign::positive, "of the amplifier");
    command.quantity("--active-arms", bridge.active_arms, "1", Sign::positive,
                     "of the bridge: 1 quarter, 2 half (opposite gauges), 2(1 + nu) full with transverse gauges");
    command.quantity("--rest", rest_s, "s", Sign::positive,
                     "time at rest at the beginning, whose mean is taken off (default: none)");
    command.choice<Dispersion>("--dispersion", dispersion,
                               {{"none", Dispersion::none}, {"pochhammer-chree", Dispersion::pochhammer_chree}},
                               "phase velocity of the waves: sqrt(E/rho), or that of the first longitudinal mode");
    command.quantity("--from", from_s, "s", Sign::any, "what comes before, by the record's time, counts as zero");
    command.quantity("--until", until_s, "s", Sign::any, "what comes after, by the record's time, counts as zero");
    command.quantity("--travel", travel_m, "m", Sign::any,
                     "carry one wave so far along the bar; negative: back to where it came from");
    command.quantity(
        "--gauge", gauges_m, "m", Sign::non_negative,
        "distance of a gauge from the bar's end, where force and velocity are wanted; once with --split, or "
        "twice");
    command.quantity(
        "--split", split_s, "s", Sign::any,
        "by the record's time: the wave to the end has passed the gauge, the wave from the end not come yet");
    command.parsed<Segment>("--striker", striker, parse_segment, "L,D,MATERIAL", "that made the pulse, for --summary");
    command.flag("--summary", summary,
                 "write one row about the arriving pulse, and the speed of its striker, instead of the waves");
    command.output(output);
  }

  [[nodiscard]] std::vector<std::string> signal_columns() const {
    if (!columns.empty()) return columns;
    return {signal == Signal::strain ? "strain" : signal == Signal::voltage ? "voltage_V" : "force_N"};
  }

  void require_consistent(const Command& command) const {
    const std::size_t gauge_count = std::max<std::size_t>(1, gauges_m.size());
    if (travel_m.has_value() == !gauges_m.empty())
      throw UsageError("--travel", "give either --travel, for one wave, or --gauge, for both waves at the bar's end");
    if (gauges_m.size() > 2) throw UsageError("--gauge", "one or two gauges separate the waves");
    if (split_s.has_value() != (gauges_m.size() == 1))
      throw UsageError("--split", "goes with one --gauge; two gauges separate the waves without it");
    if (signal_columns().size() != gauge_count)
      throw UsageError("--column", fmt::format("{} given for {} gauge{}; give one each", signal_columns().size(),
                                               gauge_count, gauge_count == 1 ? "" : "s"));
    if (signal == Signal::voltage && !(command.given("--gauge-factor") && command.given("--excitation")))
      throw UsageError("--gauge-factor", "and --excitation are required for volts");
    if (signal != Signal::voltage)
      for (const char* flag : {"--gauge-factor", "--excitation", "--gain", "--active-arms"})
        if (command.given(flag)) throw UsageError(flag, "belongs to a bridge; add --signal voltage");
    if (summary != striker.has_value()) throw UsageError("--striker", "and --summary go together");
  }
};

struct Record {
  UniformGrid grid;
  double origin_s = 0;
  std::vector<StrainWave> gauges;
};

Record read_record(const Request& request) {
  const CsvTable table = read_csv(request.files.front());
  Record record{uniform_time(table, TimeOrigin::any), table.column("time_s").front(), {}};
  const auto index = [&](const char* flag, double time_s) {
    const double at = (time_s - record.origin_s) / record.grid.step_s;
    if (!(at > -0.5 && at < static_cast<double>(record.grid.size)))
      throw UsageError(flag, fmt::format("{:g} s lies outside the record, {:g} .. {:g} s", time_s, record.origin_s,
                                         record.origin_s + record.grid.duration_s()));
    return static_cast<std::ptrdiff_t>(std::lround(at));
  };
  for (const std::string& name : request.signal_columns()) {
    std::vector<double> values = table.column(name);
    for (double& value : values) value *= request.scale;
    if (request.rest_s) {
      const double count = *request.rest_s / record.grid.step_s;
      if (!(count >= 1 && count < static_cast<double>(values.size())))
        throw UsageError("--rest", fmt::format("{:g} s is no part of the record of {:g} s", *request.rest_s,
                                               record.grid.duration_s()));
      remove_offset(values, static_cast<std::size_t>(count));
    }
    if (request.from_s) std::fill(values.begin(), values.begin() + index("--from", *request.from_s), 0.0);
    if (request.until_s) std::fill(values.begin() + index("--until", *request.until_s), values.end(), 0.0);
    record.gauges.push_back({record.grid, std::move(values)});
  }
  return record;
}

void to_strain(const Request& request, const WaveBar& bar, Record& record) {
  for (StrainWave& gauge : record.gauges) {
    if (request.signal == Signal::force) gauge = strain_of_force({gauge.grid, gauge.strain}, bar);
    if (request.signal == Signal::voltage)
      for (double& value : gauge.strain) value *= strain_per_volt(request.bridge);
  }
}

void write_pulse(const Request& request, const WaveBar& bar, const StrainWave& arriving, double origin_s) {
  const double impedance = request.striker->impedance_b_kg_per_s();
  const StrikerPulse pulse =
      striker_pulse({arriving.grid, wave_force_N(arriving, bar)}, impedance, bar.impedance_kg_per_s());
  CsvOutput output(request.output, {"striker_speed_m_per_s", "plateau_force_N", "pulse_begin_s", "pulse_length_s",
                                    "striker_round_trip_s"});
  output.row({pulse.striker_speed_m_per_s, pulse.plateau_force_N, origin_s + pulse.begin_s, pulse.length_s,
              2 * request.striker->travel_time_s()});
  output.close();
}

std::vector<double> times(const Record& record) {
  std::vector<double> time(record.grid.size);
  for (std::size_t n = 0; n < time.size(); ++n) time[n] = record.origin_s + record.grid.time_s(n);
  return time;
}

void write_wave(const Request& request, const WaveBar& bar, const StrainWave& wave, const Record& record) {
  const std::vector<double> force = wave_force_N(wave, bar);
  const std::vector<double> velocity = wave_velocity_m_per_s(wave, bar);
  const std::vector<double> time = times(record);
  write_csv(request.output,
            {{"time_s", time}, {"force_N", force}, {"velocity_m_per_s", velocity}, {"strain", wave.strain}});
}

int run(const Request& request) {
  Record record = read_record(request);
  const WaveBar bar(*request.material, request.diameter_m, request.dispersion, record.grid.step_s);
  to_strain(request, bar, record);
  if (request.travel_m) {
    const StrainWave wave = travelled(record.gauges[0], bar, *request.travel_m);
    if (request.summary)
      write_pulse(request, bar, wave, record.origin_s);
    else
      write_wave(request, bar, wave, record);
    return 0;
  }
  const EndWaves end =
      request.gauges_m.size() == 2
          ? separated_by_two(record.gauges[0], record.gauges[1], bar, request.gauges_m[0], request.gauges_m[1])
          : separated_at(record.gauges[0], bar, request.gauges_m[0], *request.split_s - record.origin_s);
  if (request.summary) {
    write_pulse(request, bar, end.arriving, record.origin_s);
    return 0;
  }
  const std::vector<double> time = times(record);
  const std::vector<double> force = end.force_N(bar);
  const std::vector<double> velocity = end.velocity_m_per_s(bar);
  const std::vector<double> arriving = wave_force_N(end.arriving, bar);
  const std::vector<double> leaving = wave_force_N(end.leaving, bar);
  write_csv(request.output, {{"time_s", time},
                             {"force_N", force},
                             {"velocity_m_per_s", velocity},
                             {"arriving_force_N", arriving},
                             {"leaving_force_N", leaving}});
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command(
      {"ir-waves", "strain gauges on a round bar -> force and velocity at its end",
       "A wave in a bar is carried from the gauge to the bar's end, or anywhere, every frequency with its own phase "
       "velocity: that of the first longitudinal mode (Pochhammer and Chree), from Poisson's ratio. With --gauge and "
       "--split the waves to and from the end are told apart by time, with two --gauge by their travel between the "
       "gauges, whatever overlaps at either (noise adds up with every passage, so set them far apart). Columns: "
       "time_s,force_N,velocity_m_per_s (force compressive, velocity towards the end) and of both "
       "waves arriving_force_N,leaving_force_N; with --travel time_s,force_N,velocity_m_per_s,strain of one wave. "
       "--summary: striker_speed_m_per_s,plateau_force_N,pulse_begin_s,pulse_length_s,striker_round_trip_s.",
       "ir-bar --segment 300mm,20mm,steel --face B --step 1us --duration 400us -o striker.csv\n"
       "ir-bar --segment 2m,20mm,steel --face A --far-end infinite --step 1us --duration 400us -o bar.csv\n"
       "ir-impact --speed 10m/s striker.csv bar.csv -o force.csv\n"
       "ir-waves --signal force --material steel:0.29 --diameter 20mm --travel 1m force.csv -o at-the-gauge.csv"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] {
    request.require_consistent(command);
    return run(request);
  });
}
