#include "impulse/measured/mode_identification.hpp"
#include "impulse/response/response_csv.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_output.hpp"
#include "lib/csv/csv_table.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace {

using namespace impulse;

struct Request {
  std::vector<std::string> files;
  IdentificationOptions options;
  bool free = false;
  std::optional<double> mass_kg;
  bool residual = false;
  bool no_dirac = false;
  bool quiet = false;
  std::optional<std::string> diagram;
  std::string output;

  void declare(Command& command) {
    command.files("RESPONSE", files, 0, 1, "response of a body at one contact");
    command.quantity("--highest-frequency", options.highest_frequency_Hz, "Hz", Sign::positive, "of the modes sought")
        .required();
    command.count("--order", options.largest_order, 2, "modes in the last line of the stabilisation diagram");
    command.count("--modes", options.modes, 1,
                  "keep so many modes, the most significant ones (default: all that are significant)");
    command.flag("--free", free, "the body is free: find its mass too, as a mode of 0 Hz");
    command.quantity("--mass", mass_kg, "kg", Sign::positive, "the body is free and has this mass");
    command.flag("--residual", residual, "find the residual flexibility too; needs displacements without drift");
    command.flag("--no-dirac", no_dirac, "the impulse response is a plain function; H and U may be missing");
    command.text("--diagram", diagram, "FILE", "write the stabilisation diagram to FILE");
    command.flag("--quiet", quiet, "do not report on stderr how well the modes fit");
    command.output(output);
  }
};

void write_diagram(const std::string& path, const std::vector<StabilisationPoint>& points) {
  CsvOutput output(path, {"order", "frequency_Hz", "damping_ratio", "stable"});
  for (const StabilisationPoint& point : points)
    output.row({static_cast<double>(point.order), point.frequency_Hz, point.damping_ratio, point.stable ? 1.0 : 0.0});
  output.close();
}

int run(Request& request) {
  if (request.free && request.mass_kg) throw UsageError("--free", "finds the mass that --mass gives; leave one out");
  if (request.free) request.options.rigid_body = RigidBody::free;
  if (request.mass_kg) {
    request.options.rigid_body = RigidBody::known;
    request.options.mass_kg = *request.mass_kg;
  }
  if (request.residual) request.options.residual = IdentificationOptions::Residual::fitted;
  const CsvTable table = read_csv(request.files.front());
  if (holds_modes(table)) throw InputError(table.file(), 0, 0, "holds modes already; give a response");
  const Identification found = identified_modes(
      response_from(table, request.no_dirac ? DiracParts::none : DiracParts::as_columns_say), request.options);
  if (!request.quiet)
    fmt::print(stderr, "ir-identify: {} modes; not explained {:.3g} of the response in the band\n",
               found.modes.mode_count(), found.relative_residual);
  if (request.diagram) write_diagram(*request.diagram, found.diagram);
  write_modes(request.output, found.modes);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command(
      {"ir-identify", "modes of a body from its measured response",
       "A record becomes a compact body: frequencies, damping ratios and participations that other tools read as "
       "modes. "
       "Poles by the shift invariance of the response's signal subspace (ESPRIT) for growing orders; those that stay "
       "are "
       "fitted together by least squares, and dropped if they do not stand out of the noise. --diagram FILE: the poles "
       "of all orders, order,frequency_Hz,damping_ratio,stable.",
       "printf 'time_s,impulse_response_per_kg\\n' > response.csv\n"
       "awk 'BEGIN { w = 6.283185*120; for (k = 0; k < 4000; ++k) { t = k*1e-4; print t \",\" exp(-0.01*w*t)*cos(w*t) "
       "} "
       "}' >> response.csv\n"
       "ir-identify --no-dirac --highest-frequency 600Hz --quiet response.csv"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return run(request); });
}
