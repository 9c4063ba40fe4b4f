// Plates: assembly, modes and response, beside the rate at which BLAS multiplies matrices here. `of_product_rate` is
// the share of that rate at which the dense eigenproblem runs: 8/3 n³ operations (Cholesky 1/3, reduction 1,
// tridiagonal 4/3) and 4 n² for each mode.
#include "impulse/bodies/ritz_plate.hpp"
#include "impulse/response/modal_response.hpp"
#include "lib/model/modal_model.hpp"
#include "lib/numerics/dense_algebra.hpp"

#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>

namespace {

using namespace impulse;

constexpr std::size_t mode_count = 200;

/// Coupled, skew by 45°, all five fields, nothing held: 5 terms² unknowns.
RitzPlate skew_laminate(std::size_t terms, const char* edges) {
  Plate plate;
  const double s = 0.1 * std::sqrt(0.5);
  plate.shape = {{{{0, 0}, {0.1, 0}, {0.1 + s, s}, {s, s}}}};
  plate.laminate = laminate(layers_of("[0/45/-30/90]", parse_ply("graphite-epoxy"), 0.005));
  plate.edges = parse_plate_edges(edges);
  return {plate, terms};
}

double product_rate(Eigen::Index n) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(n, n);
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(n, n);
  const auto begin = std::chrono::steady_clock::now();
  add_transposed_product(a, a, c);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  return 2 * std::pow(static_cast<double>(n), 3) / elapsed.count();
}

void plate_assembly(benchmark::State& state) {
  const auto terms = static_cast<std::size_t>(state.range(0));
  const RitzPlate plate = skew_laminate(terms, "FFFF");
  for (auto _ : state) benchmark::DoNotOptimize(plate.structure());
  // Five fields: 15 pairs, two forms.
  const double work = 30 * 2 * std::pow(static_cast<double>(terms), 5) * 4;
  state.counters["of_product_rate"] =
      benchmark::Counter(work / product_rate(1000), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(plate_assembly)->Arg(12)->Arg(20)->Arg(30)->Unit(benchmark::kMillisecond);

void plate_modes(benchmark::State& state) {
  const RitzPlate plate = skew_laminate(static_cast<std::size_t>(state.range(0)), "CFCF");
  DenseStructure body = plate.structure();
  body.contacts = plate.mean_deflection({0, 0}, 0.002);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        modal_model(body, {.mode_count = mode_count, .residual = ModalOptions::Residual::attached}));
  const auto n = static_cast<double>(plate.unknown_count());
  state.counters["unknowns"] = n;
  state.counters["of_product_rate"] =
      benchmark::Counter((8.0 / 3 * n * n * n + 4 * n * n * mode_count) / product_rate(1000),
                         benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(plate_modes)->Arg(12)->Arg(16)->Arg(20)->Unit(benchmark::kMillisecond);

/// All that ir-plate does: assembly, the lowest 200 modes, a response of 2000 samples.
void plate_response(benchmark::State& state) {
  const UniformGrid grid{1e-6, 2001};
  const char* edges = state.range(1) == 0 ? "CCCC" : "FFFF";
  for (auto _ : state) {
    const RitzPlate plate = skew_laminate(static_cast<std::size_t>(state.range(0)), edges);
    DenseStructure body = plate.structure();
    body.contacts = plate.mean_deflection({0, 0}, 0.002);
    const ModalModel modes =
        modal_model(body, {.mode_count = mode_count, .residual = ModalOptions::Residual::attached});
    benchmark::DoNotOptimize(modal_response(modes, grid));
    state.counters["unknowns"] = static_cast<double>(plate.unknown_count());
  }
}
BENCHMARK(plate_response)
    ->ArgNames({"terms", "free"})
    ->Args({12, 0})
    ->Args({12, 1})
    ->Args({20, 0})
    ->Args({20, 1})
    ->Unit(benchmark::kMillisecond);

}  // namespace
