#include "impulse/contact/contact_equation.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/response_csv.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/law/impact_csv.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

namespace {

using namespace impulse;

struct Request {
  std::vector<std::string> responses;
  double speed_m_per_s = 0;
  ContactMethod method = ContactMethod::product;
  std::optional<double> mass_1_kg;
  std::optional<double> step_s;
  std::optional<double> duration_s;
  bool no_dirac = false;
  bool summary = false;
  std::string output;

  void declare(Command& command) {
    command.files("RESPONSE", responses, 2, 2, "responses of the arriving body and of the one at rest; - is stdin");
    command.quantity("--speed", speed_m_per_s, "m/s", Sign::positive, "of body 1 towards body 2").required();
    command.choice<ContactMethod>("--method", method,
                                  {{"product", ContactMethod::product},
                                   {"trapezoidal", ContactMethod::trapezoidal},
                                   {"fourier", ContactMethod::fourier},
                                   {"series", ContactMethod::series}},
                                  "how the contact equation is solved");
    command.quantity("--mass-1", mass_1_kg, "kg", Sign::positive, "mass of body 1, for its rebound speed (default: from its 0 Hz mode)");
    command.quantity("--step", step_s, "s", Sign::positive, "time step, where a RESPONSE holds modes");
    command.quantity("--duration", duration_s, "s", Sign::positive, "duration, where a RESPONSE holds modes");
    command.flag("--no-dirac", no_dirac, "the impulse responses are plain functions; H and U may be missing");
    command.flag("--summary", summary, "write one row about the impact instead of its history");
    command.output(output);
  }
};

struct Body {
  Response response;
  std::optional<double> mass_kg;
};

Body body_from(const CsvTable& table, const Request& request) {
  if (!holds_modes(table)) return {response_from(table, request.no_dirac ? DiracParts::none : DiracParts::as_columns_say), std::nullopt};
  const ModalModel modes = modes_from(table);
  if (!request.step_s) throw UsageError("--step", fmt::format("is required, since {} holds modes", table.file()));
  if (!request.duration_s) throw UsageError("--duration", fmt::format("is required, since {} holds modes", table.file()));
  std::optional<double> mass;
  if (modes.mode_count() > 0 && modes.angular_frequency(0) == 0) mass = 1 / std::pow(modes.participation(0, 0), 2);
  return {modal_response(modes, grid_over(*request.duration_s, *request.step_s)), mass};
}

int run(const Request& request, const Command& command) {
  if (request.responses[0] == "-" && request.responses[1] == "-") throw UsageError("RESPONSE", "stdin can be only one of the two");
  const CsvTable table_1 = read_csv(request.responses[0]);
  const CsvTable table_2 = read_csv(request.responses[1]);
  if (!holds_modes(table_1) && !holds_modes(table_2))
    for (const char* flag : {"--step", "--duration"})
      if (command.given(flag)) throw UsageError(flag, "is that of the responses; it is for modes");
  const Body body_1 = body_from(table_1, request);
  const Body body_2 = body_from(table_2, request);
  const ImpactHistory history = solve_contact(body_1.response, body_2.response, {request.speed_m_per_s}, request.method);
  if (!history.separated)
    fmt::print(stderr, "ir-impact: the responses end during contact, after {:g} s; compute them with a longer --duration\n",
               history.grid.duration_s());
  const std::optional<double> mass = request.mass_1_kg ? request.mass_1_kg : body_1.mass_kg;
  if (request.summary)
    write_summary(request.output, summary(history, request.speed_m_per_s, mass));
  else
    write_history(request.output, history);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command({"ir-impact", "impact force of two bodies from their impulse responses",
                   "Solves V = (G1 + G2)*F while the faces stick, until the force stops being positive; it is zero from there on. Methods: product "
                   "(kernel integrated exactly, marching), series (the same by division of power series), fourier (the same on a shifted contour), "
                   "trapezoidal (on the sampled impulse response; for modal responses with modes up to the Nyquist frequency). Order 2 in the step, jumps "
                   "apart. Columns: time_s,force_N,velocity_1_m_per_s,velocity_2_m_per_s.",
                   "ir-cone --length 400mm --diameters 30mm,75mm --material nylon-6 --face A --step 1us --duration 1ms -o cone.csv\n"
                   "ir-bar --segment 6150mm,10mm,steel --face A --step 1us --duration 1ms -o rod.csv\n"
                   "ir-impact --speed 1.16m/s --summary cone.csv rod.csv"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return run(request, command); });
}
