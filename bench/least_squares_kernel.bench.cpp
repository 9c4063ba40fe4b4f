#include "impulse/measured/least_squares_kernel.hpp"
#include "impulse/measured/averaged_spectra.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <random>

namespace {

using namespace impulse;

/// Records of a million samples: half sines of 200 on a slow, damped oscillation, with 1 % of noise.
std::vector<InputOutput> records(std::size_t count) {
  constexpr std::size_t size = 1'000'000;
  std::mt19937_64 engine(1);
  std::normal_distribution<double> noise(0, 1e-2);
  std::vector<InputOutput> made;
  for (std::size_t b = 0; b < count; ++b) {
    InputOutput record{std::vector<double>(size), std::vector<double>(size)};
    for (std::size_t k = 0; k <= 200; ++k)
      record.input[50 + k] = std::sin(std::numbers::pi * static_cast<double>(k) / 200);
    for (std::size_t n = 50; n < size; ++n) {
      const auto t = static_cast<double>(n - 50);
      record.output[n] = std::exp(-2e-5 * t) * std::sin(2.5e-3 * t) + noise(engine);
    }
    made.push_back(std::move(record));
  }
  return made;
}

void estimate_from_a_million_samples(benchmark::State& state) {
  const std::vector<InputOutput> made = records(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    const double regularisation = cross_validated_regularisation(averaged_spectra(made));
    benchmark::DoNotOptimize(least_squares_kernel(made, {.regularisation = regularisation}).values.data());
  }
}
BENCHMARK(estimate_from_a_million_samples)->Arg(1)->Arg(10)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
