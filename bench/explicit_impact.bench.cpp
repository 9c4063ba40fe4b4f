// Explicit finite elements: cost per element and step, by both matchings.
#include "fem/explicit/explicit_impact.hpp"
#include "fem/bodies/bar_structure.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace impulse;

void explicit_stepping(benchmark::State& state, Matching matching) {
  const double step = 1e-6 / static_cast<double>(state.range(0));
  const Bar cone{{parse_segment("400mm,30mm,75mm,nylon-6")}, {Face::a}, FarEnd::free};
  const Bar rod{{parse_segment("6150mm,10mm,steel")}, {Face::a}, FarEnd::free};
  const BarMesh cone_mesh = bar_mesh_by_step(cone, step);
  const BarMesh rod_mesh = bar_mesh_by_step(rod, step);
  const Structure projectile = bar_structure(cone, cone_mesh);
  const Structure target = bar_structure(rod, rod_mesh);
  ExplicitImpact impact;
  impact.speed_m_per_s = 1.16;
  impact.step_s = step;
  impact.duration_s = 0.5e-3;
  impact.matching = matching;
  double trials = 0;
  for (auto _ : state) trials += static_cast<double>(explicit_impact(projectile, target, impact).trial_count);
  const double elements = static_cast<double>(cone_mesh.elements[0] + rod_mesh.elements[0]);
  state.counters["trials"] = trials / static_cast<double>(state.iterations());
  state.counters["per_element_and_trial"] =
      benchmark::Counter(trials * elements, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(explicit_stepping, direct, Matching::direct)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(explicit_stepping, bisection, Matching::bisection)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
