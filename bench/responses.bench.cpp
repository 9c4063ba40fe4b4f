// Responses and modes: rows show the cost per sample and mode.
#include "impulse/exact/bar_modes.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/wave_response.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace impulse;

Bar cone() { return {{parse_segment("400mm,30mm,75mm,nylon-6")}, {Face::a}, FarEnd::free}; }
Bar rod() { return {{parse_segment("6150mm,10mm,steel")}, {Face::a}, FarEnd::free}; }

void modal_sum(benchmark::State& state) {
  const auto modes = static_cast<std::size_t>(state.range(0));
  const UniformGrid grid{1e-7, 10001};
  const ModalModel model = exact_bar_modes(rod(), {.count = modes});
  for (auto _ : state) benchmark::DoNotOptimize(modal_response(model, grid));
  state.counters["per_sample_and_mode"] =
      benchmark::Counter(static_cast<double>(grid.size) * static_cast<double>(modes),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(modal_sum)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

void exact_modes(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(exact_bar_modes(cone(), {.count = static_cast<std::size_t>(state.range(0))}));
}
BENCHMARK(exact_modes)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

void waves_in_a_cone(benchmark::State& state) {
  const UniformGrid grid{1e-3 / static_cast<double>(state.range(0)), static_cast<std::size_t>(state.range(0)) + 1};
  for (auto _ : state) benchmark::DoNotOptimize(wave_response(cone(), grid));
}
BENCHMARK(waves_in_a_cone)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);

void waves_in_seven_cylinders(benchmark::State& state) {
  Profile profile;
  const double lengths[] = {0.031, 0.043, 0.059, 0.037, 0.047, 0.053, 0.041};
  const char* materials[] = {"steel", "nylon-6", "aluminium", "steel", "nylon-6", "aluminium", "steel"};
  for (int i = 0; i < 7; ++i) profile.push_back({lengths[i], 0.02, 0.02, parse_material(materials[i])});
  const UniformGrid grid{1e-6, static_cast<std::size_t>(state.range(0)) + 1};
  for (auto _ : state) benchmark::DoNotOptimize(wave_response({profile, {Face::a}, FarEnd::free}, grid));
}
BENCHMARK(waves_in_seven_cylinders)->Arg(300)->Arg(1000)->Arg(3000)->Unit(benchmark::kMillisecond);

}  // namespace
