#include "impulse/contact/contact_equation.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/response_csv.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/law/impact_csv.hpp"
#include "tools/support/contacts_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

using namespace impulse;

/// A method for one rigid contact, or the march for everything.
enum class Method { product, trapezoidal, fourier, series, online };

ContactMethod contact_method(Method method) {
  switch (method) {
    case Method::trapezoidal:
      return ContactMethod::trapezoidal;
    case Method::fourier:
      return ContactMethod::fourier;
    case Method::series:
      return ContactMethod::series;
    case Method::product:
    case Method::online:
      break;
  }
  return ContactMethod::product;
}

struct Request {
  std::vector<std::string> responses;
  double speed_m_per_s = 0;
  Method method = Method::product;
  ContactsRequest contacts;
  std::optional<double> mass_1_kg;
  std::optional<double> mass_2_kg;
  std::optional<double> step_s;
  std::optional<double> duration_s;
  bool no_dirac = false;
  bool summary = false;
  std::string output;

  void declare(Command& command) {
    command.files("RESPONSE1 RESPONSE2", responses, 2, 64,
                  "responses of the arriving body and of the one at rest, or of a row of bodies, the inner ones struck "
                  "at both faces; - is stdin");
    command.quantity("--speed", speed_m_per_s, "m/s", Sign::non_negative, "of body 1 towards body 2").required();
    command.choice<Method>(
        "--method", method,
        {{"product", Method::product},
         {"trapezoidal", Method::trapezoidal},
         {"fourier", Method::fourier},
         {"series", Method::series},
         {"online", Method::online}},
        "how the contact equation is solved; laws, re-contact and more than one contact are always marched online");
    contacts.declare(command);
    command.quantity("--mass-1", mass_1_kg, "kg", Sign::positive,
                     "mass of body 1, for its rebound speed (default: from its 0 Hz mode)");
    command.quantity("--mass-2", mass_2_kg, "kg", Sign::positive,
                     "mass of body 2, for the restitution (default: from its 0 Hz mode)");
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
  if (!holds_modes(table))
    return {response_from(table, request.no_dirac ? DiracParts::none : DiracParts::as_columns_say), std::nullopt};
  const ModalModel modes = modes_from(table);
  if (!request.step_s) throw UsageError("--step", fmt::format("is required, since {} holds modes", table.file()));
  if (!request.duration_s)
    throw UsageError("--duration", fmt::format("is required, since {} holds modes", table.file()));
  std::optional<double> mass;
  if (modes.mode_count() > 0 && modes.angular_frequency(0) == 0) mass = 1 / std::pow(modes.participation(0, 0), 2);
  return {modal_response(modes, grid_over(*request.duration_s, *request.step_s)), mass};
}

void run_first_contact(const Request& request, const Body& body_1, const Body& body_2) {
  const ImpactHistory history =
      solve_contact(body_1.response, body_2.response, {request.speed_m_per_s}, contact_method(request.method));
  if (!history.separated)
    fmt::print(stderr,
               "ir-impact: the responses end during contact, after {:g} s; compute them with a longer --duration\n",
               history.grid.duration_s());
  if (request.summary)
    write_summary(request.output, summary(history, request.speed_m_per_s, body_1.mass_kg));
  else
    write_history(request.output, history);
}

std::vector<Body> read_bodies(const Request& request, const Command& command) {
  std::vector<CsvTable> tables;
  for (const std::string& path : request.responses) tables.push_back(read_csv(path));
  const auto modal = static_cast<std::size_t>(std::ranges::count_if(tables, holds_modes));
  if (modal == 0)
    for (const char* flag : {"--step", "--duration"})
      if (command.given(flag)) throw UsageError(flag, "is that of the responses; it is for modes");
  if (request.no_dirac && modal == tables.size())
    throw UsageError("--no-dirac", "is for impulse responses, but all files hold modes; leave it out");
  std::vector<Body> bodies;
  for (const CsvTable& table : tables) bodies.push_back(body_from(table, request));
  if (request.mass_1_kg) bodies.front().mass_kg = request.mass_1_kg;
  if (request.mass_2_kg) bodies.back().mass_kg = request.mass_2_kg;
  return bodies;
}

int run(const Request& request, const Command& command) {
  for (const char* flag : {"--mass-1", "--mass-2"})
    if (command.given(flag) && !request.summary) throw UsageError(flag, "is for --summary; add it or leave it out");
  const std::vector<Body> bodies = read_bodies(request, command);
  const bool several =
      bodies.size() > 2 || bodies[0].response.contact_count > 1 || bodies[1].response.contact_count > 1;
  const bool marched = several || request.method == Method::online || request.contacts.asked(command);
  if (marched && command.given("--method") && request.method != Method::online)
    throw UsageError("--method",
                     "solves one rigid contact up to its first separation; use --method online for laws, gaps, "
                     "re-contact and several contacts");
  if (!marched) {
    if (command.given("--mass-2"))
      throw UsageError("--mass-2", "is for the restitution, which --method online reports");
    run_first_contact(request, bodies[0], bodies[1]);
    return 0;
  }
  std::vector<Response> responses;
  for (const Body& body : bodies) responses.push_back(body.response);
  request.contacts.run(responses, request.speed_m_per_s, bodies.front().mass_kg, bodies.back().mass_kg, request.summary,
                       request.output);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command({"ir-impact", "impact force of two bodies from their impulse responses",
                   "Solves V = (G1 + G2)*F while the faces stick, until the force stops being positive; it is zero "
                   "from there on. Methods: product "
                   "(kernel integrated exactly, marching), series (the same by division of power series), fourier (the "
                   "same on a shifted contour), "
                   "trapezoidal (on the sampled impulse response; for modal responses with modes up to the Nyquist "
                   "frequency). Order 2 in the step, jumps "
                   "apart. Columns: time_s,force_N,velocity_1_m_per_s,velocity_2_m_per_s. With a contact law, a gap, a "
                   "preload, re-contact, a row of bodies or several points of "
                   "contact the forces are marched (online), conserving energy; then also indentation_m (minus the gap "
                   "where open), running_impulse_Ns, in_contact, the "
                   "faces' displacements, the contact's stored and dissipated energy and the work received by each "
                   "body. Several contacts number their columns: force_1_N; "
                   "velocity_12_m_per_s is that of side 2 of contact 1.",
                   "ir-cone --length 400mm --diameters 30mm,75mm --material nylon-6 --face A --step 1us --duration 1ms "
                   "-o cone.csv\n"
                   "ir-bar --segment 6150mm,10mm,steel --face A --step 1us --duration 1ms -o rod.csv\n"
                   "ir-impact --speed 1.16m/s --summary cone.csv rod.csv"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return run(request, command); });
}
