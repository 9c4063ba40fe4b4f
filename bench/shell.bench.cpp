// The internal force of a shell, and its tangent: what a nonlinear step costs.
#include "fem/shell/shell.hpp"
#include "fem/reduced_basis/panel_impact.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace impulse;

Shell square(std::size_t count) {
  const Laminate plies =
      laminate(layers_of("[0/45/0/-45/0]2s", parse_ply("120GPa:7.9GPa:0.3:5.5GPa:5.5GPa:5.5GPa:1580kg/m3"), 2.69e-3));
  return Shell({{.length_m = 0.1524, .width_m = 0.1016, .curvature = Curvature::along_y, .radius_m = 0.6725},
                plies,
                parse_edges("IIII"),
                graded_lines(0.1524, count, 0, 1),
                graded_lines(0.1016, count, 0, 1)});
}

void shell_internal_force(benchmark::State& state) {
  const Shell shell = square(static_cast<std::size_t>(state.range(0)));
  const Eigen::VectorXd z = Eigen::VectorXd::Constant(shell.size(), 1e-6);
  for (auto _ : state) benchmark::DoNotOptimize(shell.internal(z));
}
BENCHMARK(shell_internal_force)->Arg(8)->Arg(16)->Arg(32)->Unit(benchmark::kMicrosecond);

void shell_tangent(benchmark::State& state) {
  const Shell shell = square(static_cast<std::size_t>(state.range(0)));
  const Eigen::VectorXd z = Eigen::VectorXd::Constant(shell.size(), 1e-6);
  for (auto _ : state) benchmark::DoNotOptimize(shell.tangent(z));
}
BENCHMARK(shell_tangent)->Arg(8)->Unit(benchmark::kMillisecond);

/// One step of 2 µs of the sphere's impact, in the middle of its first 100 µs.
void panel_step(benchmark::State& state, PanelMethod method) {
  const Shell shell = square(static_cast<std::size_t>(state.range(0)));
  const Structure body = shell_structure(shell, {{0.0762, 0.0508}});
  const ImplicitImpactSetup setup{.striker_mass_kg = 8.537e-3, .speed_m_per_s = 3, .step_s = 2e-6};
  PanelImpact panel(shell, body, ContactLaw::hertz(1.413e9), setup, {.method = method});
  for (auto _ : state) panel.advance();
  state.counters["iterations"] =
      benchmark::Counter(static_cast<double>(panel.impact().iteration_count()), benchmark::Counter::kAvgIterations);
}
BENCHMARK_CAPTURE(panel_step, full, PanelMethod::full)->Arg(8)->Arg(16)->Iterations(200)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(panel_step, tensor, PanelMethod::tensor)
    ->Arg(8)
    ->Arg(16)
    ->Arg(32)
    ->Iterations(200)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
