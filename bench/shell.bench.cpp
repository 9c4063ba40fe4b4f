// The internal force of a shell, and its tangent: what a nonlinear step costs.
#include "fem/shell/shell.hpp"
#include "tests/support/shells.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace impulse;

Shell square(std::size_t count) {
  PanelShape shape{.length_m = 0.15, .width_m = 0.10, .curvature = Curvature::along_y, .radius_m = 0.7};
  return Shell(shells::panel(shape, shells::isotropic(70e9, 0.3, 2e-3, 2700), "IIII", count, count));
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

}  // namespace
