#include "impulse/contact/contact_equation.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/law/impact_csv.hpp"
#include "tools/support/contacts_request.hpp"
#include "tools/support/draw_request.hpp"
#include "tools/support/struck_bodies.hpp"

#include <fmt/format.h>

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
  StruckBodiesRequest bodies;
  double speed_m_per_s = 0;
  Method method = Method::product;
  ContactsRequest contacts;
  DrawRequest draws;
  bool summary = false;
  std::string output;

  void declare(Command& command) {
    bodies.declare(command);
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
    draws.declare(command);
    command.flag("--summary", summary, "write one row about the impact instead of its history");
    command.output(output);
  }
};

void run_first_contact(const Request& request, const StruckBodies& bodies) {
  const ImpactHistory history =
      solve_contact(bodies.response(0), bodies.response(1), {request.speed_m_per_s}, contact_method(request.method));
  if (!history.separated)
    fmt::print(stderr,
               "ir-impact: the responses end during contact, after {:g} s; compute them with a longer --duration\n",
               history.grid.duration_s());
  if (request.summary)
    write_summary(request.output, summary(history, request.speed_m_per_s, bodies.mass_1_kg()));
  else
    write_history(request.output, history);
}

ForceOutcome outcome_of(const ImpactSummary& line, std::vector<double> force_N, bool in_contact_at_end) {
  return {std::move(force_N), line.peak_force_N, line.contact_duration_s, line.impulse_Ns, in_contact_at_end};
}

void run_draws(const Request& request, const StruckBodies& bodies, bool marched) {
  const double speed = request.speed_m_per_s;
  if (!marched) {
    request.draws.run(
        bodies,
        [&](const StruckBodies& drawn) {
          ImpactHistory history =
              solve_contact(drawn.response(0), drawn.response(1), {speed}, contact_method(request.method));
          const ImpactSummary line = summary(history, speed, std::nullopt);
          return outcome_of(line, std::move(history.force_N), !history.separated);
        },
        request.summary, request.output);
    return;
  }
  const ContactsProblem problem = request.contacts.problem(bodies, speed);
  request.draws.run(
      bodies,
      [&](const StruckBodies& drawn) {
        ContactsSolution solution = solve_contacts(drawn.contact_bodies(), drawn.grid(), problem);
        const ImpactSummary line = contacts_summary(solution.traces, drawn.grid(), {.speed_1_m_per_s = speed}).impact;
        return outcome_of(line, std::move(solution.traces.front().force_N), solution.in_contact_at_end);
      },
      request.summary, request.output);
}

int run(const Request& request, const Command& command) {
  request.draws.require_consistent(command);
  const StruckBodies bodies = request.bodies.read(command);
  const bool marched = bodies.joint_count() > 1 || request.method == Method::online || request.contacts.asked(command);
  if (marched && command.given("--method") && request.method != Method::online)
    throw UsageError("--method",
                     "solves one rigid contact up to its first separation; use --method online for laws, gaps, "
                     "re-contact and several contacts");
  if (!marched && command.given("--history"))
    throw UsageError("--history", "is for contacts that are marched (--method online)");
  if (request.draws.asked()) {
    run_draws(request, bodies, marched);
    return 0;
  }
  if (marched) {
    request.contacts.run(bodies, request.speed_m_per_s, request.summary, request.output);
    return 0;
  }
  if (command.given("--mass-1") && !request.summary)
    throw UsageError("--mass-1", "is for --summary, or for the energies that --method online reports");
  if (command.given("--mass-2")) throw UsageError("--mass-2", "is for the restitution, which --method online reports");
  run_first_contact(request, bodies);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command(
      {"ir-impact", "impact force of two bodies from their impulse responses",
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
       "faces' displacements, the contact's stored and dissipated energy the work received by each "
       "body, energy_balance_J (the sum of these energies) and, of a free body whose mass is known, "
       "translational_energy_1_J = p^2/2m. Several contacts number their columns: force_1_N; "
       "velocity_12_m_per_s is that of side 2 of contact 1. Where a response has an uncertainty (ir-estimate "
       "--members; or columns ..._std_... alone, taken as one number's error), --draws carries it to the "
       "force by Monte Carlo.",
       "ir-cone --length 400mm --diameters 30mm,75mm --material nylon-6 --face A --step 1us --duration 1ms "
       "-o cone.csv\n"
       "ir-bar --segment 6150mm,10mm,steel --face A --step 1us --duration 1ms -o rod.csv\n"
       "ir-impact --speed 1.16m/s --summary cone.csv rod.csv"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return run(request, command); });
}
