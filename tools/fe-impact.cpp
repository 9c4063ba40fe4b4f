#include "fem/explicit/explicit_contact.hpp"
#include "lib/cli/law_options.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/law/impact_csv.hpp"
#include "tools/support/body_file.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <optional>
#include <string>

namespace {

using namespace impulse;

struct Request {
  std::string projectile;
  std::string target;
  ExplicitImpact impact;
  std::optional<std::size_t> projectile_elements;
  std::optional<std::size_t> target_elements;
  LawOptions law;
  std::optional<double> gap_m;
  std::optional<double> speed_2_m_per_s;
  bool recontact = false;
  std::optional<std::string> contacts;
  bool summary = false;
  std::string output;

  void declare(Command& command) {
    command.text("--projectile", projectile, "FILE", "body file (TOML) of the arriving body").required();
    command.text("--target", target, "FILE", "body file (TOML) of the body at rest").required();
    command.quantity("--speed", impact.speed_m_per_s, "m/s", Sign::positive, "of the projectile towards the target")
        .required();
    command
        .quantity("--step", impact.step_s, "s", Sign::positive,
                  "time step of the target; the force is linear within it")
        .required();
    command.count("--subcycles", impact.projectile_subcycles, 1, "steps of the projectile within one of the target");
    command.quantity("--duration", impact.duration_s, "s", Sign::positive, "duration of the record").required();
    command.count("--projectile-elements", projectile_elements, 1,
                  "elements (default: as many as its step is stable for)");
    command.count("--target-elements", target_elements, 1, "elements (default: as many as the step is stable for)");
    command.choice<Matching>("--match", impact.matching,
                             {{"direct", Matching::direct}, {"bisection", Matching::bisection}},
                             "how the force that makes the face velocities agree is found");
    command.choice<ImpactStart>(
        "--start", impact.start,
        {{"impedance", ImpactStart::wave_admittance}, {"held", ImpactStart::held}, {"zero", ImpactStart::zero}},
        "first force: V/(1/Z1 + 1/Z2), that of the first step, or 0 (as published)");
    law.declare(command);
    command.quantity("--gap", gap_m, "m", Sign::non_negative, "gap at t = 0 (default: 0)");
    command.quantity("--speed-2", speed_2_m_per_s, "m/s", Sign::any,
                     "of the target, in the direction of --speed (default: 0)");
    command.flag("--recontact", recontact, "let bodies that parted touch again");
    command.output_file("--contacts", contacts, "write a row for every period of contact to FILE");
    command.flag("--summary", summary, "write one row about the impact instead of its history");
    command.output(output);
  }

  /// Whether the question goes past a rigid interface up to its first separation.
  [[nodiscard]] bool asks_contact(const Command& command) const {
    for (const char* flag : {"--law", "--gap", "--speed-2", "--recontact", "--contacts"})
      if (command.given(flag)) return true;
    return false;
  }
};

DescribedBody read_struck_body(const std::string& path) {
  DescribedBody body = read_body_file(path);
  if (body.contact_count != 1)
    throw InputError(path == "-" ? "stdin" : path, 0, 0, "face: a body of an impact has one face in contact, A or B");
  return body;
}

Structure discretised(const DescribedBody& body, const std::string& role, std::optional<std::size_t> elements,
                      double step_s) {
  if (elements && body.divisible == Divisible::no)
    throw UsageError("--" + role + "-elements", fmt::format("the {} is a {}, which has none", role, body.kind));
  try {
    return body.structure({step_s, elements});
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", role, error.what()));
  }
}

void warn_of_end(const UniformGrid& grid) {
  fmt::print(stderr, "fe-impact: the record ends during contact, after {:g} s; use a longer --duration\n",
             grid.duration_s());
}

ExplicitContact contact_of(const Request& request, const Command& command) {
  const ExplicitImpact& impact = request.impact;
  ExplicitContact contact{.speed_m_per_s = impact.speed_m_per_s,
                          .speed_2_m_per_s = request.speed_2_m_per_s.value_or(0),
                          .step_s = impact.step_s,
                          .projectile_subcycles = impact.projectile_subcycles,
                          .duration_s = impact.duration_s,
                          .gap_m = request.gap_m.value_or(0),
                          .law = request.law.laws(1).front(),
                          .after_contact = request.recontact ? AfterContact::touch_again : AfterContact::go_on,
                          .matching = impact.matching,
                          .start = impact.start};
  if (contact.speed_2_m_per_s >= contact.speed_m_per_s)
    throw UsageError("--speed-2",
                     fmt::format("the target is no slower ({} m/s) than the projectile ({} m/s); they never meet",
                                 contact.speed_2_m_per_s, contact.speed_m_per_s));
  for (const char* flag : {"--match", "--start"})
    if (command.given(flag) && !contact.law.is_rigid())
      throw UsageError(flag, "is for a rigid contact; this law yields");
  if (command.given("--start") && contact.gap_m > 0)
    throw UsageError("--start", "is for bodies that touch at t = 0; there is a --gap");
  return contact;
}

void run_contact(const Request& request, const ExplicitContact& contact, const DescribedBody& first,
                 const DescribedBody& second, const Structure& projectile, const Structure& target) {
  const ExplicitContactResult result = explicit_contact(projectile, target, contact);
  if (result.in_contact_at_end) warn_of_end(result.grid);
  if (request.contacts) write_intervals(*request.contacts, result.grid, {result.trace});
  if (!request.summary) {
    write_traces(request.output, result.grid, {result.trace});
    return;
  }
  const ContactsScene scene{.speed_1_m_per_s = contact.speed_m_per_s,
                            .speed_2_m_per_s = contact.speed_2_m_per_s,
                            .mass_1_kg = first.free_mass_kg,
                            .mass_2_kg = second.free_mass_kg,
                            .energy_error = result.energy_error};
  write_summary(request.output, contacts_summary({result.trace}, result.grid, scene));
}

int run(const Request& request, const Command& command) {
  if (request.projectile == "-" && request.target == "-")
    throw UsageError("--target", "standard input ('-') can be read only once");
  const DescribedBody first = read_struck_body(request.projectile);
  const DescribedBody second = read_struck_body(request.target);
  (void)grid_over(request.impact.duration_s, request.impact.step_s);  // refuses too many samples before they cost time
  std::optional<ExplicitContact> contact;
  if (request.asks_contact(command)) contact = contact_of(request, command);
  const double projectile_step = request.impact.step_s / static_cast<double>(request.impact.projectile_subcycles);
  const Structure target = discretised(second, "target", request.target_elements, request.impact.step_s);
  const Structure projectile = discretised(first, "projectile", request.projectile_elements, projectile_step);
  if (contact) {
    run_contact(request, *contact, first, second, projectile, target);
    return 0;
  }
  const ExplicitImpactResult result = explicit_impact(projectile, target, request.impact);
  if (!result.history.separated) warn_of_end(result.history.grid);
  if (request.summary)
    write_summary(request.output, summary(result.history, request.impact.speed_m_per_s, first.free_mass_kg));
  else
    write_history(request.output, result.history);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command(
      {"fe-impact", "impact force of two bodies by explicit finite elements",
       "Central differences with lumped mass; the projectile may take several steps within one of the target; the face "
       "velocities agree at the end of each step of the target. Elements are as short as stability allows, equal in "
       "travel time, so that waves cross them in one step where the lengths permit; then the lattice is free of "
       "dispersion. A body is a " +
           body_kinds() +
           ". With a law, a gap, a --speed-2, --recontact or --contacts the record has the columns of ir-impact's. "
           "Shares no code with the impulse-response method.",
       "printf 'body = \"bar\"\\nsegment = [\"0.5m,10mm,steel\"]\\nface = \"A\"\\n' > rod.toml\n"
       "fe-impact --projectile rod.toml --target rod.toml --speed 1m/s --step 0.5us --duration 300us --summary"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return run(request, command); });
}
