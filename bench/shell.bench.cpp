// What a nonlinear step of a shell costs, its parts, and whole impacts by tensors beside the whole mesh.
#include "fem/shell/shell.hpp"
#include "fem/reduced_basis/panel_impact.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>

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

/// Processor time, so that what else runs on the machine counts little [s].
double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct RunCost {
  double mesh_s = 0, set_up_s = 0, stepping_s = 0;

  [[nodiscard]] double total_s() const { return set_up_s + stepping_s; }
};

/// The sphere's impact from the panel's description on, in steps of 2 µs.
RunCost run_cost(PanelMethod method, std::size_t elements, double duration_s) {
  RunCost cost;
  const double start = cpu_s();
  const Shell shell = square(elements);
  const Structure body = shell_structure(shell, {{0.0762, 0.0508}});
  cost.mesh_s = cpu_s() - start;
  const ImplicitImpactSetup setup{.striker_mass_kg = 8.537e-3, .speed_m_per_s = 3, .step_s = 2e-6};
  PanelImpact panel(shell, body, ContactLaw::tan_sun(1.413e9, 0.094, 1.667e-4), setup, {.method = method});
  cost.set_up_s = cpu_s() - start;
  for (long k = 0; k < std::lround(duration_s / setup.step_s); ++k) panel.advance();
  cost.stepping_s = cpu_s() - start - cost.set_up_s;
  return cost;
}

/// The nonlinear impact by tensors (60 vectors, 12 finite) beside the whole mesh, one after the other in every round,
/// the least time of each counting: how many times faster a step is, and the run with its set-up; and the most that
/// could be had, if vectors, tensors and steps were free and only mesh and matrices remained.
void panel_run(benchmark::State& state) {
  const auto elements = static_cast<std::size_t>(state.range(0));
  const double duration_s = static_cast<double>(state.range(1)) * 1e-6;
  const double steps = duration_s / 2e-6;
  RunCost full{1e9, 1e9, 1e9}, tensor = full;
  const auto keep_least = [](RunCost& least, const RunCost& cost) {
    least = {std::min(least.mesh_s, cost.mesh_s), std::min(least.set_up_s, cost.set_up_s),
             std::min(least.stepping_s, cost.stepping_s)};
  };
  for (auto _ : state) {
    keep_least(full, run_cost(PanelMethod::full, elements, duration_s));
    keep_least(tensor, run_cost(PanelMethod::tensor, elements, duration_s));
  }
  state.counters["full_ms"] = full.total_s() * 1e3;
  state.counters["tensor_ms"] = tensor.total_s() * 1e3;
  state.counters["full_step_us"] = full.stepping_s / steps * 1e6;
  state.counters["tensor_step_us"] = tensor.stepping_s / steps * 1e6;
  state.counters["step_ratio"] = full.stepping_s / tensor.stepping_s;
  state.counters["run_ratio"] = full.total_s() / tensor.total_s();
  state.counters["most"] = full.total_s() / std::min(full.mesh_s, tensor.mesh_s);
}
BENCHMARK(panel_run)->Args({8, 500})->Args({8, 2000})->Args({8, 4000})->Iterations(10)->Unit(benchmark::kMillisecond);
BENCHMARK(panel_run)->Args({16, 500})->Args({16, 2000})->Iterations(3)->Unit(benchmark::kMillisecond);
BENCHMARK(panel_run)->Args({32, 500})->Args({32, 2000})->Iterations(1)->Unit(benchmark::kMillisecond);

/// A sparse factorisation of a shell's stiffness, and solutions of one and of 78 right-hand sides together.
void shell_factorisation(benchmark::State& state) {
  const Shell shell = square(static_cast<std::size_t>(state.range(0)));
  const Eigen::SparseMatrix<double> stiffness = shell.tangent(Eigen::VectorXd::Zero(shell.size()));
  for (auto _ : state) benchmark::DoNotOptimize(SparseCholesky::of(stiffness));
}
BENCHMARK(shell_factorisation)->Arg(8)->Arg(16)->Arg(32)->Unit(benchmark::kMillisecond);

void shell_solution(benchmark::State& state) {
  const Shell shell = square(static_cast<std::size_t>(state.range(0)));
  const auto factor = SparseCholesky::of(shell.tangent(Eigen::VectorXd::Zero(shell.size())));
  const Eigen::MatrixXd b = Eigen::MatrixXd::Ones(shell.size(), state.range(1));
  for (auto _ : state) benchmark::DoNotOptimize(factor->solve(b));
}
BENCHMARK(shell_solution)->ArgsProduct({{8, 16, 32}, {1, 78}})->Unit(benchmark::kMillisecond);

}  // namespace
