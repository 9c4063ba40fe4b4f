#include "impulse/measured/averaged_spectra.hpp"

#include "tests/support/direct_sums.hpp"
#include "tests/support/records.hpp"

#include <doctest/doctest.h>

#include <array>

using namespace impulse;

namespace {

std::vector<double> ringing(std::size_t size) {
  std::vector<double> kernel(size);
  for (std::size_t n = 0; n < size; ++n) {
    const auto t = static_cast<double>(n);
    kernel[n] = std::exp(-0.05 * t) * std::cos(0.4 * t);
  }
  return kernel;
}

std::vector<InputOutput> blows(std::size_t count, double input_noise, double output_noise, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::vector<InputOutput> records;
  for (std::size_t b = 0; b < count; ++b) {
    std::vector<double> input = records::half_sine(600, 1, 6, 1 + 0.1 * static_cast<double>(b % 5));
    std::vector<double> output = convolution(input, ringing(600), 600);
    records::add_noise(input, input_noise, engine);
    records::add_noise(output, output_noise, engine);
    records.push_back({std::move(input), std::move(output)});
  }
  return records;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += (a[n] - b[n]) * (a[n] - b[n]);
  return std::sqrt(sum);
}

constexpr std::array estimators{SpectralEstimator::h1, SpectralEstimator::h2, SpectralEstimator::hv};

}  // namespace

TEST_CASE("averaged_spectra: every estimator returns a kernel that decays, and full coherence, without noise") {
  std::vector<InputOutput> records = blows(3, 0, 0, 1);
  for (InputOutput& record : records) {  // a pulse whose spectrum has no zeros
    record.input.assign(600, 0.0);
    for (std::size_t n = 1; n < 100; ++n) record.input[n] = std::pow(0.7, static_cast<double>(n));
    record.output = convolution(record.input, ringing(600), 600);
  }
  const AveragedSpectra spectra = averaged_spectra(records);
  for (SpectralEstimator estimator : estimators) {
    const EstimatedKernel kernel = spectral_kernel(records, spectra, estimator, 0);
    // What the kernel is after the record, e^-30.
    CHECK(direct::largest_difference(kernel.values, ringing(600)) < 1e-11);
    for (const auto& deviation : kernel.deviations) CHECK(records::rms(deviation) < 1e-11);
  }
  for (double value : spectra.coherence()) CHECK(value > 1 - 1e-9);
}

TEST_CASE("averaged_spectra: noise on the output biases H2 upwards, on the input H1 downwards, Hv half as much") {
  const auto at_resonance = [](const std::vector<double>& kernel) {
    std::complex<double> sum = 0;
    for (std::size_t n = 0; n < kernel.size(); ++n) sum += std::polar(kernel[n], -0.4 * static_cast<double>(n));
    return std::abs(sum);
  };
  const double exact = at_resonance(ringing(600));
  const auto ratio = [&](double input_noise, double output_noise, SpectralEstimator estimator) {
    const std::vector<InputOutput> records = blows(400, input_noise, output_noise, 5);
    return at_resonance(spectral_kernel(records, averaged_spectra(records), estimator, 1e-2).values) / exact;
  };
  const double h1 = ratio(0, 0.5, SpectralEstimator::h1);
  const double h2 = ratio(0, 0.5, SpectralEstimator::h2);
  const double hv = ratio(0, 0.5, SpectralEstimator::hv);
  CHECK(std::abs(h1 - 1) < 0.05);
  CHECK(h2 > hv);
  CHECK(hv > h1);
  const double h1_input = ratio(0.05, 0, SpectralEstimator::h1);
  const double h2_input = ratio(0.05, 0, SpectralEstimator::h2);
  CHECK(h1_input < 0.97);
  CHECK(std::abs(h2_input - 1) < 0.02);
}

TEST_CASE("averaged_spectra: deviations are those of estimates without one record each") {
  const std::vector<InputOutput> records = blows(4, 0.01, 0.02, 9);
  const AveragedSpectra spectra = averaged_spectra(records);
  for (SpectralEstimator estimator : estimators) {
    const EstimatedKernel all = spectral_kernel(records, spectra, estimator, 1e-2);
    const auto without = [&](std::size_t b) {
      std::vector<InputOutput> rest = records;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(b));
      const AveragedSpectra fewer = averaged_spectra(rest);
      // λ for each record stays the same.
      const double regularisation = 0.75 * 1e-2 * spectra.largest_input_power() / fewer.largest_input_power();
      return spectral_kernel({}, fewer, estimator, regularisation).values;
    };
    REQUIRE(all.deviations.size() == 4);
    const std::vector<double> first = without(0), third = without(2);
    double error = 0, sum = 0;
    for (std::size_t n = 0; n < 600; ++n) {
      const double difference = all.deviations[2][n] - all.deviations[0][n];
      error = std::max(error, std::abs(difference - std::sqrt(0.75) * (first[n] - third[n])));
      double all_four = 0;
      for (const auto& deviation : all.deviations) all_four += deviation[n];
      sum = std::max(sum, std::abs(all_four));
    }
    CHECK(error < 1e-12);
    CHECK(sum < 1e-12);
  }
}

// H2 is not here: it divides by S_fv, which may vanish, so that its scatter has no finite variance.
TEST_CASE("averaged_spectra: the standard uncertainty of five records is the scatter of their estimates") {
  constexpr int repetitions = 150;
  for (SpectralEstimator estimator : {SpectralEstimator::h1, SpectralEstimator::hv}) {
    CAPTURE(static_cast<int>(estimator));
    std::vector<double> sum(600), squares(600);
    double stated = 0, scatter = 0;
    for (unsigned repetition = 0; repetition < repetitions; ++repetition) {
      std::vector<InputOutput> records = blows(5, 0.01, 0.02, 100 + repetition);
      for (std::size_t b = 0; b < 5; ++b)  // alike, since unequal blows do not weigh alike (docs/decisions/0014)
        for (auto* values : {&records[b].input, &records[b].output})
          for (double& value : *values) value /= 1 + 0.1 * static_cast<double>(b);
      const EstimatedKernel found = spectral_kernel(records, averaged_spectra(records), estimator, 1e-2);
      for (std::size_t n = 0; n < 600; ++n) {
        sum[n] += found.values[n];
        squares[n] += found.values[n] * found.values[n];
        for (const auto& deviation : found.deviations) stated += deviation[n] * deviation[n] / repetitions;
      }
    }
    for (std::size_t n = 0; n < 600; ++n) scatter += (squares[n] - sum[n] * sum[n] / repetitions) / (repetitions - 1);
    const double ratio = std::sqrt(stated / scatter);
    CHECK(ratio > 0.93);
    CHECK(ratio < 1.07);
  }
}

TEST_CASE("averaged_spectra: both rules come near the best regularisation") {
  for (double noise : {1e-3, 1e-2, 1e-1}) {
    CAPTURE(noise);
    const std::vector<InputOutput> records = blows(5, 0, noise, 21);
    const AveragedSpectra spectra = averaged_spectra(records);
    const auto error = [&](double regularisation) {
      return distance(spectral_kernel(records, spectra, SpectralEstimator::h1, regularisation).values, ringing(600));
    };
    double best = HUGE_VAL;
    for (double regularisation = 1e-12; regularisation < 1; regularisation *= 2)
      best = std::min(best, error(regularisation));
    CHECK(error(cross_validated_regularisation(spectra)) < 1.5 * best);
    // The corner of the curve over-regularises when the noise is small.
    CHECK(error(l_curve_regularisation(spectra)) < 6 * best);
  }
}

TEST_CASE("averaged_spectra: refusals") {
  const std::vector<InputOutput> zero{{{0, 0, 0}, {1, 2, 3}}};
  CHECK_THROWS_WITH_AS((void)averaged_spectra(zero), doctest::Contains("zero throughout"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)averaged_spectra({}), doctest::Contains("no record"), std::invalid_argument);
  const std::vector<InputOutput> records = blows(2, 0, 0, 1);
  CHECK_THROWS_WITH_AS((void)spectral_kernel(records, averaged_spectra(records), SpectralEstimator::h1, -1),
                       doctest::Contains("negative"), std::invalid_argument);
}
