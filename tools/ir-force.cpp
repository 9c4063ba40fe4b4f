#include "impulse/measured/force_estimate.hpp"
#include "impulse/response/response_csv.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_output.hpp"
#include "lib/csv/csv_table.hpp"
#include "tools/support/motion_record.hpp"
#include "tools/support/regularisation_option.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace {

using namespace impulse;

struct Request {
  std::vector<std::string> files;
  MotionRecord motion;
  Regularisation regularisation;
  bool quiet = false;
  std::string output;

  void declare(Command& command) {
    command.files(
        "RESPONSE RECORD", files, 2, 2,
        "response of the body where it was struck, and a CSV file with time_s and its motion there; - is stdin");
    motion.declare(command);
    declare_regularisation(command, regularisation);
    command.flag("--quiet", quiet, "do not report on stderr what was chosen");
    command.output(output);
  }
};

int run(const Request& request) {
  request.motion.require_consistent();
  const CsvTable response = read_csv(request.files[0]);
  const CsvTable record = read_csv(request.files[1]);
  const UniformGrid grid = uniform_time(record, TimeOrigin::any);
  const ForceEstimate estimate = estimated_force({grid, request.motion.velocity_m_per_s(record, grid.step_s)},
                                                 response_from(response), request.regularisation);
  if (!request.quiet)
    fmt::print(stderr, "ir-force: regularisation {:.3g}{}\n", estimate.regularisation,
               rule_name(request.regularisation.rule));
  write_csv(request.output, {{"time_s", record.column("time_s")}, {"force_N", estimate.force_N}});
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command(
      {"ir-force", "force on a body from its velocity and its impulse response",
       "For impacts that cannot carry a load cell: finds the force whose convolution with the response is the recorded "
       "velocity, by causal least squares. The body is at rest when the record begins, and nothing else moves it. The "
       "response must have the record's step and be longer by a step. Frequencies at which the body hardly moves are "
       "held back by regularisation. Columns: time_s,force_N.",
       "ir-mass --mass 2kg --step 10us --duration 2.5ms -o mass.csv\n"
       "printf 'time_s,velocity_m_per_s\\n' > motion.csv\n"
       "awk 'BEGIN { for (k = 0; k < 200; ++k) { f = k < 20 ? 100*sin(k*3.14159265/20) : 0; v += (f + last)/2*1e-5/2; "
       "last = f; print k*1e-5 \",\" v } }' >> motion.csv\n"
       "ir-force --quiet mass.csv motion.csv -o force.csv"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return run(request); });
}
