#include "impulse/measured/bootstrap.hpp"

#include "lib/contract/require.hpp"
#include "lib/numerics/seeded_draws.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {

std::vector<std::vector<double>> bootstrap_deviations(
    std::span<const InputOutput> records, const Bootstrap& options,
    const std::function<std::vector<double>(std::span<const InputOutput>)>& estimate) {
  require(records.size() > 1, "a bootstrap draws from two blows at least; {} has no spread", records.size());
  require(options.resamples >= 40, "{} resamples do not tell an uncertainty; use 40 at least", options.resamples);
  std::vector<std::vector<double>> deviations(options.resamples);
  for_each_draw(options.resamples, options.seed, options.threads, [&](std::size_t r, std::mt19937_64& engine) {
    std::uniform_int_distribution<std::size_t> pick(0, records.size() - 1);
    std::vector<InputOutput> resample;
    for (std::size_t b = 0; b < records.size(); ++b) resample.push_back(records[pick(engine)]);
    deviations[r] = estimate(resample);
  });

  const std::size_t size = std::ranges::min(deviations, {}, [](const auto& x) { return x.size(); }).size();
  const auto count = static_cast<double>(records.size());
  const auto resamples = static_cast<double>(options.resamples);
  const double scale = std::sqrt(count / ((count - 1) * (resamples - 1)));
  std::vector<double> mean(size);
  for (auto& x : deviations) {
    x.resize(size);
    for (std::size_t n = 0; n < size; ++n) mean[n] += x[n] / resamples;
  }
  for (auto& x : deviations)
    for (std::size_t n = 0; n < size; ++n) x[n] = scale * (x[n] - mean[n]);
  return deviations;
}

}  // namespace impulse
