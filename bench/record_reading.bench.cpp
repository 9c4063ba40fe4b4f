// Two-column text to CSV, in time per sample.
#include "lib/records/record_csv.hpp"
#include "lib/records/record_format.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

using namespace impulse;

std::string text_record(std::size_t samples) {
  const std::string path = (std::filesystem::temp_directory_path() / fmt::format("bench-{}.txt", ::getpid())).string();
  std::ofstream file(path);
  file << "time_s\tforce_N\n";
  for (std::size_t k = 0; k < samples; ++k) {
    const double x = static_cast<double>(k);
    file << fmt::format("{:.7f}\t{:.6e}\n", 1e-7 * x, std::sin(1e-4 * x));
  }
  return path;
}

void text_to_csv(benchmark::State& state) {
  const auto samples = static_cast<std::size_t>(state.range(0));
  const std::string path = text_record(samples);
  for (auto _ : state) {
    const RecordFile file(path);
    write_record_csv("/dev/null", *read_records(file, {}).front());
  }
  std::filesystem::remove(path);
  state.counters["per_sample"] = benchmark::Counter(
      static_cast<double>(samples), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(text_to_csv)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond);

}  // namespace
