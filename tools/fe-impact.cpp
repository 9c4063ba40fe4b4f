#include "fem/bodies/bar_structure.hpp"
#include "fem/explicit/explicit_impact.hpp"
#include "lib/cli/bar_options.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/law/impact_csv.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace {

using namespace impulse;

struct Request {
  std::string projectile;
  std::string target;
  ExplicitImpact impact;
  std::optional<std::size_t> projectile_elements;
  std::optional<std::size_t> target_elements;
  bool summary = false;
  std::string output;

  void declare(Command& command) {
    command.text("--projectile", projectile, "FILE", "body file (TOML) of the arriving body").required();
    command.text("--target", target, "FILE", "body file (TOML) of the body at rest").required();
    command.quantity("--speed", impact.speed_m_per_s, "m/s", Sign::positive, "of the projectile towards the target").required();
    command.quantity("--step", impact.step_s, "s", Sign::positive, "time step of the target; the force is linear within it").required();
    command.count("--subcycles", impact.projectile_subcycles, 1, "steps of the projectile within one of the target");
    command.quantity("--duration", impact.duration_s, "s", Sign::positive, "duration of the record").required();
    command.count("--projectile-elements", projectile_elements, 1, "elements (default: as many as its step is stable for)");
    command.count("--target-elements", target_elements, 1, "elements (default: as many as the step is stable for)");
    command.choice<Matching>("--match", impact.matching, {{"direct", Matching::direct}, {"bisection", Matching::bisection}},
                             "how the force that makes the face velocities agree is found");
    command.choice<ImpactStart>("--start", impact.start,
                                {{"impedance", ImpactStart::wave_admittance}, {"held", ImpactStart::held}, {"zero", ImpactStart::zero}},
                                "first force: V/(1/Z1 + 1/Z2), that of the first step, or 0 (as published)");
    command.flag("--summary", summary, "write one row about the impact instead of its history");
    command.output(output);
  }
};

Bar read_struck_bar(const std::string& path) {
  Bar bar = read_bar_file(path);
  if (bar.faces.size() != 1) throw InputError(path, 0, 0, "face: a body of an impact has one face in contact, A or B");
  return bar;
}

Structure discretised(const Bar& bar, const char* role, std::optional<std::size_t> elements, double step_s) {
  try {
    return bar_structure(bar, elements ? bar_mesh_by_count(bar, *elements) : bar_mesh_by_step(bar, step_s));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", role, error.what()));
  }
}

int run(const Request& request) {
  if (request.projectile == "-" && request.target == "-")
    throw UsageError("--target", "standard input ('-') can be read only once");
  const Bar projectile = read_struck_bar(request.projectile);
  const Bar target = read_struck_bar(request.target);
  (void)grid_over(request.impact.duration_s, request.impact.step_s);  // refuses too many samples before they cost time
  const double projectile_step = request.impact.step_s / static_cast<double>(request.impact.projectile_subcycles);
  const ExplicitImpactResult result =
      explicit_impact(discretised(projectile, "projectile", request.projectile_elements, projectile_step),
                      discretised(target, "target", request.target_elements, request.impact.step_s), request.impact);
  if (!result.history.separated)
    fmt::print(stderr, "fe-impact: the record ends during contact, after {:g} s; use a longer --duration\n",
               result.history.grid.duration_s());
  if (request.summary)
    write_summary(request.output, summary(result.history, request.impact.speed_m_per_s, mass_kg(projectile.profile)));
  else
    write_history(request.output, result.history);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command({"fe-impact", "impact force of two bodies by explicit finite elements",
                   "Central differences with lumped mass; the projectile may take several steps within one of the target; the face velocities agree "
                   "at the end of each step of the target. Elements are as short as stability allows, equal in travel time, so that waves cross them "
                   "in one step where the lengths permit; then the lattice is free of dispersion. Shares no code with the impulse-response method.",
                   "printf 'body = \"bar\"\\nsegment = [\"0.5m,10mm,steel\"]\\nface = \"A\"\\n' > rod.toml\n"
                   "fe-impact --projectile rod.toml --target rod.toml --speed 1m/s --step 0.5us --duration 300us --summary"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return run(request); });
}
