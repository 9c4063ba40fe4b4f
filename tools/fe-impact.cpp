#include "fem/explicit/explicit_contacts.hpp"
#include "lib/cli/law_options.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/law/impact_csv.hpp"
#include "lib/model/plane_face.hpp"
#include "tools/support/body_file.hpp"
#include "tools/support/two_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace impulse;

struct Request {
  std::string projectile;
  std::string target;
  std::vector<std::string> between;
  std::optional<PlaneFace> plane_face;
  ExplicitImpact impact;
  std::optional<std::size_t> projectile_elements;
  std::optional<std::size_t> target_elements;
  LawOptions law;
  std::vector<double> gaps_m;
  std::optional<double> speed_2_m_per_s;
  bool recontact = false;
  std::optional<std::string> contacts;
  bool summary = false;
  std::string output;

  void declare(Command& command) {
    command.text("--projectile", projectile, "FILE", "body file (TOML) of the arriving body").required();
    command.text("--target", target, "FILE", "body file (TOML) of the body at rest").required();
    command.text("--between", between, "FILE",
                 "body file (TOML) of a body between them, struck at both faces (face = \"A,B\"); repeat in the order "
                 "of the row");
    command.choice<PlaneFace>("--plane-face", plane_face, {{"1", PlaneFace::first}, {"2", PlaneFace::second}},
                              "the projectile (1) or the target (2) has one contact, a plane face, which meets every "
                              "point of the other");
    command.quantity("--speed", impact.speed_m_per_s, "m/s", Sign::positive, "of the projectile towards the target")
        .required();
    command
        .quantity("--step", impact.step_s, "s", Sign::positive,
                  "time step of all bodies but the projectile; the force is linear within it")
        .required();
    command.count(
        "--subcycles", impact.projectile_subcycles, 1,
        "steps of the projectile within one of the others; for a mesh as fine as its step permits, else a rigid "
        "contact zigzags");
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
        "how the force begins: so that the faces' masses meet within half a step (the record shows V/(1/Z1 + 1/Z2)), "
        "as the force of the first step, or with 0 (as published). With all but impedance it zigzags from step to step "
        "for ever where the step is below its limit, from zero by 15 to 22 % of it in the published cases");
    law.declare(command);
    command.quantity("--gap", gaps_m, "m", Sign::non_negative,
                     "gap at t = 0 (default: 0); one for all contacts or one each");
    command.quantity("--speed-2", speed_2_m_per_s, "m/s", Sign::any,
                     "of body 2, in the direction of --speed (default: 0)");
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

/// Has one of two bodies meet every point of the other with its plane face.
void spread_plane_face(std::vector<DescribedBody>& bodies, PlaneFace which) {
  if (bodies.size() != 2) throw UsageError("--plane-face", "is for two bodies");
  DescribedBody& plane = which == PlaneFace::first ? bodies.front() : bodies.back();
  const std::size_t points = (which == PlaneFace::first ? bodies.back() : bodies.front()).contact_count;
  if (plane.contact_count != 1)
    throw UsageError("--plane-face",
                     fmt::format("a plane face is one contact, but the {} has {}",
                                 which == PlaneFace::first ? "projectile" : "target", plane.contact_count));
  plane.contact_count = points;
  plane.structure = [one = plane.structure, points](const ExplicitMesh& mesh) { return plane_face(one(mesh), points); };
}

/// The bodies of the row, read in order.
std::vector<DescribedBody> read_bodies(const Request& request) {
  std::vector<std::string> paths = request.between;
  paths.insert(paths.begin(), request.projectile);
  paths.push_back(request.target);
  if (std::ranges::count(paths, "-") > 1) throw UsageError("--target", "standard input ('-') can be read only once");
  std::vector<DescribedBody> bodies;
  for (std::size_t b = 0; b < paths.size(); ++b) {
    bodies.push_back(read_body_file(paths[b]));
    const std::size_t count = bodies.back().contact_count;
    const std::string file = paths[b] == "-" ? "stdin" : paths[b];
    const bool inner = b > 0 && b + 1 < paths.size();
    if (inner && count != 2)
      throw InputError(file, 0, 0, "a body between two others takes part with two contacts, such as face = \"A,B\"");
    if (!inner && paths.size() > 2 && count != 1)
      throw InputError(file, 0, 0, "a body at the end of a row has one contact, such as face = \"A\"");
  }
  if (request.plane_face) spread_plane_face(bodies, *request.plane_face);
  const std::size_t first = bodies.front().contact_count, last = bodies.back().contact_count;
  if (bodies.size() == 2 && first != last)
    throw InputError(request.target == "-" ? "stdin" : request.target, 0, 0,
                     fmt::format("has {} contacts, the projectile {}; they meet pair by pair", last, first));
  return bodies;
}

ExplicitBody discretised(const DescribedBody& body, const std::string& role, std::optional<std::size_t> elements,
                         double step_s, std::size_t subcycles) {
  if (elements && body.divisible == Divisible::no)
    throw UsageError("--" + role + "-elements", fmt::format("a {} is not divided by a number of elements", body.kind));
  try {
    return {body.structure({step_s / static_cast<double>(subcycles), elements}), 0, subcycles};
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", role, error.what()));
  }
}

/// All but the projectile first, since the step is theirs.
std::vector<ExplicitBody> discretised(const Request& request, const std::vector<DescribedBody>& bodies) {
  std::vector<ExplicitBody> row(bodies.size());
  for (std::size_t b = bodies.size(); b-- > 0;) {
    const std::string role = body_name(b, bodies.size());
    if (b == 0)
      row[b] = discretised(bodies[b], role, request.projectile_elements, request.impact.step_s,
                           request.impact.projectile_subcycles);
    else
      row[b] = discretised(bodies[b], role, role == "target" ? request.target_elements : std::nullopt,
                           request.impact.step_s, 1);
  }
  row[0].speed_m_per_s = request.impact.speed_m_per_s;
  row[1].speed_m_per_s = request.speed_2_m_per_s.value_or(0);
  return row;
}

void warn_of_end(const UniformGrid& grid) {
  fmt::print(stderr, "fe-impact: the record ends during contact, after {:g} s; use a longer --duration\n",
             grid.duration_s());
}

ExplicitContacts contacts_of(const Request& request, const Command& command, std::size_t count) {
  const ExplicitImpact& impact = request.impact;
  ExplicitContacts contacts{.step_s = impact.step_s,
                            .duration_s = impact.duration_s,
                            .laws = request.law.laws(count),
                            .gaps_m = request.gaps_m,
                            .after_contact = request.recontact ? AfterContact::touch_again : AfterContact::go_on,
                            .matching = impact.matching,
                            .start = impact.start};
  if (contacts.gaps_m.size() <= 1)
    contacts.gaps_m.assign(count, contacts.gaps_m.empty() ? 0.0 : contacts.gaps_m.front());
  if (contacts.gaps_m.size() != count)
    throw UsageError("--gap", fmt::format("given {} times for {} contacts; give it once, or once for each",
                                          contacts.gaps_m.size(), count));
  const double speed_2 = request.speed_2_m_per_s.value_or(0);
  if (speed_2 >= impact.speed_m_per_s)
    throw UsageError("--speed-2",
                     fmt::format("the target is no slower ({} m/s) than the projectile ({} m/s); they never meet",
                                 speed_2, impact.speed_m_per_s));
  const bool any_rigid = std::ranges::any_of(contacts.laws, &ContactLaw::is_rigid);
  for (const char* flag : {"--match", "--start"})
    if (command.given(flag) && !any_rigid) throw UsageError(flag, "is for a rigid contact; this law yields");
  if (command.given("--start") && std::ranges::none_of(contacts.gaps_m, [](double gap) { return gap == 0; }))
    throw UsageError("--start", "is for bodies that touch at t = 0; there is a --gap");
  if (impact.matching == Matching::bisection && count > 1)
    throw UsageError("--match", "bisection finds the force of one contact; use direct");
  return contacts;
}

/// p²/2m of the first and the last body, where nothing holds them.
std::vector<BodyEnergy> energies(const Request& request, const std::vector<DescribedBody>& bodies,
                                 const ExplicitContactsResult& result) {
  const std::span<const ContactTrace> all(result.traces);
  const bool two_bodies = bodies.size() == 2;
  std::vector<BodyEnergy> energies;
  if (const std::optional<double> mass = bodies.front().free_mass_kg)
    energies.push_back(translational_energy({1, *mass, request.impact.speed_m_per_s, -1, 0}, result.grid,
                                            two_bodies ? all : all.first(1)));
  if (const std::optional<double> mass = bodies.back().free_mass_kg)
    energies.push_back(
        translational_energy({bodies.size(), *mass, two_bodies ? request.speed_2_m_per_s.value_or(0) : 0, +1, 0},
                             result.grid, two_bodies ? all : all.last(1)));
  return energies;
}

void run_contacts(const Request& request, const ExplicitContacts& contacts, const std::vector<DescribedBody>& bodies,
                  const std::vector<ExplicitBody>& row) {
  const ExplicitContactsResult result = explicit_contacts(row, contacts);
  if (result.in_contact_at_end) warn_of_end(result.grid);
  if (request.contacts) write_intervals(*request.contacts, result.grid, result.traces);
  if (!request.summary) {
    write_traces(request.output, result.grid, result.traces, energies(request, bodies, result));
    return;
  }
  const bool two_bodies = bodies.size() == 2;
  const ContactsScene scene{.speed_1_m_per_s = row[0].speed_m_per_s,
                            .speed_2_m_per_s = row[1].speed_m_per_s,
                            .mass_1_kg = bodies.front().free_mass_kg,
                            .mass_2_kg = two_bodies ? bodies.back().free_mass_kg : std::nullopt,
                            .contacts_of_body_1 = two_bodies ? result.traces.size() : 1,
                            .energy_error = result.energy_error};
  write_summary(request.output, contacts_summary(result.traces, result.grid, scene));
}

int run(const Request& request, const Command& command) {
  require_apart("--contacts", request.contacts, request.output);
  const std::vector<DescribedBody> bodies = read_bodies(request);
  const std::size_t count = bodies.size() == 2 ? bodies[0].contact_count : bodies.size() - 1;
  (void)grid_over(request.impact.duration_s, request.impact.step_s);  // refuses too many samples before they cost time
  std::optional<ExplicitContacts> contacts;
  if (count > 1 || request.asks_contact(command)) contacts = contacts_of(request, command, count);
  const std::vector<ExplicitBody> row = discretised(request, bodies);
  if (contacts) {
    run_contacts(request, *contacts, bodies, row);
    return 0;
  }
  const ExplicitImpactResult result = explicit_impact(row[0].structure, row[1].structure, request.impact);
  if (!result.history.separated) warn_of_end(result.history.grid);
  if (request.summary)
    write_summary(request.output, summary(result.history, request.impact.speed_m_per_s, bodies[0].free_mass_kg));
  else
    write_history(request.output, result.history);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command(
      {"fe-impact", "impact forces of two or more bodies by explicit finite elements",
       "Central differences; the projectile may take several steps within one of the others; the face velocities agree "
       "at the end of each step. Elements are as short as stability allows, equal in travel time, so that waves cross "
       "them in one step where the lengths permit; then the lattice is free of dispersion. A body is a " +
           body_kinds() +
           ". Two bodies may touch at several points (face = \"A,B\"); --between makes a row. With a law, a gap, a "
           "--speed-2, --recontact or --contacts, or several contacts, the record has the columns of ir-impact's. A "
           "rigid contact that closes or opens within a step does so at the nearest sample, order 1 in the step; where "
           "that matters, take a stiff linear law, of order 2. Where rigid contacts close the masses of the faces' "
           "nodes "
           "meet like plastic bodies: the energy error is what that costs, and goes with the mesh. Beams by Hermite "
           "elements carry short waves at any speed: the moments at which rigid contacts on them open do not settle "
           "with the mesh, only impulses do; take a law. A body given by its modes gives way by what they leave "
           "out, in series with the law; a rigid contact then is that spring. Shares no code with the impulse-response "
           "method.",
       "printf 'body = \"bar\"\\nsegment = [\"0.5m,10mm,steel\"]\\nface = \"A\"\\n' > rod.toml\n"
       "fe-impact --projectile rod.toml --target rod.toml --speed 1m/s --step 0.5us --duration 300us --summary"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return run(request, command); });
}
