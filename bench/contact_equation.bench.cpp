// The contact equation against its limit: one FFTW real transform of twice the length, planned the same way, in the
// same run.
#include "impulse/contact/contact_equation.hpp"
#include "impulse/contact/toeplitz_solvers.hpp"
#include "impulse/exact/bar_modes.hpp"
#include "impulse/response/wave_response.hpp"
#include "lib/transform/power_series.hpp"

#include <benchmark/benchmark.h>

#include <chrono>

namespace {

using namespace impulse;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Weights of a steel rod of 0.5 m on a long one, `size` of them over ten round trips.
std::vector<double> rod_weights(std::size_t size) {
  const Material steel = parse_material("steel");
  const Bar rod{{{0.5, 0.01, 0.01, steel}}, {Face::a}, FarEnd::free};
  const Bar target{{{6.15, 0.01, 0.01, steel}}, {Face::a}, FarEnd::free};
  const UniformGrid grid{20 * travel_time_s(rod.profile) / static_cast<double>(size), size + 1};
  const Response a = wave_response(rod, grid);
  const Response b = wave_response(target, grid);
  std::vector<double> u(size + 1);
  for (std::size_t k = 1; k <= size; ++k)
    u[k] = a.pair(0, 0).step_displacement_m_per_N[k] + b.pair(0, 0).step_displacement_m_per_N[k];
  std::vector<double> w(size);
  w[0] = u[1] / grid.step_s;
  for (std::size_t k = 1; k < size; ++k) w[k] = (u[k + 1] - 2 * u[k] + u[k - 1]) / grid.step_s;
  return w;
}

void series(benchmark::State& state) {
  const auto size = static_cast<std::size_t>(state.range(0));
  const std::vector<double> w = rod_weights(size);
  const std::vector<double> b(size, 1.0);
  PowerSeriesDivision division(size, RealFft::Planning::measure);
  const RealFft fft(2 * size, RealFft::Planning::measure);
  RealBuffer time(2 * size, 1.0);
  ComplexBuffer spectrum(size + 1);
  double own = 0;
  double transform = 0;
  std::size_t refinements = 0;
  double residual = 0;
  for (auto _ : state) {
    const auto start = Clock::now();
    const auto result = division.divide(b, w, 1e-9);
    own += seconds_since(start);
    refinements += result.refinements;
    residual = result.residual;
    state.PauseTiming();
    const auto transform_start = Clock::now();
    fft.forward(time, spectrum);
    transform += seconds_since(transform_start);
    state.ResumeTiming();
  }
  state.counters["transforms"] = own / transform;
  state.counters["refinements"] = static_cast<double>(refinements) / static_cast<double>(state.iterations());
  state.counters["residual"] = residual;
}
BENCHMARK(series)->RangeMultiplier(16)->Range(1 << 12, 1 << 20)->Unit(benchmark::kMillisecond);

void marching(benchmark::State& state) {
  const auto size = static_cast<std::size_t>(state.range(0));
  const std::vector<double> w = rod_weights(size);
  const std::vector<double> b(size, 1.0);
  for (auto _ : state) benchmark::DoNotOptimize(marched_toeplitz(w, b, [](auto) { return false; }));
}
BENCHMARK(marching)->RangeMultiplier(16)->Range(1 << 12, 1 << 20)->Unit(benchmark::kMillisecond);

void contour(benchmark::State& state) {
  const auto size = static_cast<std::size_t>(state.range(0));
  const std::vector<double> w = rod_weights(size);
  const std::vector<double> b(size, 1.0);
  for (auto _ : state) benchmark::DoNotOptimize(contour_toeplitz(w, b, 1e-3));
}
BENCHMARK(contour)->RangeMultiplier(16)->Range(1 << 12, 1 << 20)->Unit(benchmark::kMillisecond);

}  // namespace
