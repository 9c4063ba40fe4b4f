#include "fem/bodies/bar_structure.hpp"
#include "fem/explicit/explicit_impact.hpp"
#include "impulse/contact/contact_equation.hpp"
#include "impulse/exact/bar_modes.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/wave_response.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/csv/csv_output.hpp"
#include "lib/series/series_comparison.hpp"
#include "tools/support/published_case.hpp"

#include <algorithm>
#include <ctime>

namespace {

using namespace impulse;

constexpr double duration_s = 1e-3;  // every contact of the four cases ends before
constexpr double reference_step_s = 0.1e-6;

/// Exact modes up to the Nyquist frequency of the step and the trapezoidal rule: the published method.
ImpactHistory by_impulse_response(const PublishedCase& c, double step_s) {
  const UniformGrid grid = grid_over(duration_s, step_s);
  const ModeRange range{.highest_frequency_Hz = (0.5 + 1e-9) / step_s};
  return solve_contact(modal_response(exact_bar_modes(c.projectile, range), grid),
                       modal_response(exact_bar_modes(c.target, range), grid), {c.speed_m_per_s},
                       ContactMethod::trapezoidal);
}

ImpactHistory by_finite_elements(const PublishedCase& c, double step_s, std::size_t subcycles, ImpactStart start) {
  const Structure projectile =
      bar_structure(c.projectile, bar_mesh_by_step(c.projectile, step_s / static_cast<double>(subcycles)));
  const Structure target = bar_structure(c.target, bar_mesh_by_step(c.target, step_s));
  return explicit_impact(projectile, target,
                         {.speed_m_per_s = c.speed_m_per_s,
                          .step_s = step_s,
                          .projectile_subcycles = subcycles,
                          .duration_s = duration_s,
                          .matching = Matching::bisection,
                          .start = start})
      .history;
}

/// Travelling waves at a step a hundred times finer: what both methods approximate.
UniformSeries reference_force(const PublishedCase& c) {
  const UniformGrid grid = grid_over(duration_s, reference_step_s);
  return {grid, solve_contact(wave_response(c.projectile, grid), wave_response(c.target, grid), {c.speed_m_per_s},
                              ContactMethod::product)
                    .force_N};
}

struct Request {
  std::string experiments = "data/experiments";
  std::size_t repeat = 1;
  std::size_t subcycles = 4;
  ImpactStart start = ImpactStart::wave_admittance;
  std::string output;

  void declare(Command& command) {
    command.text("--experiments", experiments, "DIR", "folder of the cases tca, tcb, cca, ccb");
    command.count("--repeat", repeat, 1, "runs of each; the shortest counts");
    command.count("--subcycles", subcycles, 1, "finite elements: steps of the projectile within one of the target");
    command.choice<ImpactStart>(
        "--start", start,
        {{"impedance", ImpactStart::wave_admittance}, {"held", ImpactStart::held}, {"zero", ImpactStart::zero}},
        "finite elements: first force, as in fe-impact");
    command.output(output);
  }
};

int run(const Request& request) {
  CsvOutput out(request.output, {"case", "method", "step_s", "cpu_s", "published_cpu_s", "ratio", "relative_l2"});
  for (const char* id : {"tca", "tcb", "cca", "ccb"}) {
    const PublishedCase c = read_published_case(request.experiments, id);
    const UniformSeries reference = reference_force(c);
    const ComparisonWindow contact{first_contact_end_s(reference), {}, 0};
    for (const PublishedRun& published : c.runs) {
      double cpu_s = 0;
      ImpactHistory history;
      for (std::size_t k = 0; k < request.repeat; ++k) {
        const std::clock_t begin = std::clock();
        history = published.method == "impulse-response"
                      ? by_impulse_response(c, published.step_s)
                      : by_finite_elements(c, published.step_s, request.subcycles, request.start);
        const double own = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        cpu_s = k == 0 ? own : std::min(cpu_s, own);
      }
      const double l2 = series_difference(reference, {history.grid, history.force_N}, contact).relative_l2;
      // The clock ticks in microseconds; a run shorter than a tick is not infinitely faster.
      const double ratio = published.cpu_s / std::max(cpu_s, 1.0 / CLOCKS_PER_SEC);
      out.row({std::string(id), published.method, published.step_s, cpu_s, published.cpu_s, ratio, l2});
    }
  }
  out.close();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Command command({"table-4-1", "CPU times of both methods in the four Hopkinson-bar cases, beside the published ones",
                   "Each row is one run at the published step: impulse-response (exact modes up to the Nyquist "
                   "frequency, trapezoidal rule) and "
                   "finite-elements (central differences, bisection, elements as short as stability allows). cpu_s is "
                   "the process's CPU time from the "
                   "bodies to the force, ratio is published over own, relative_l2 the error against travelling waves "
                   "at 0.1 us, jumps included.",
                   "table-4-1 --repeat 3"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return run(request); });
}
