#include "impulse/measured/averaged_spectra.hpp"

#include "lib/contract/require.hpp"
#include "lib/transform/real_fft.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {

namespace {

using Complex = std::complex<double>;

constexpr double least_regularisation = 1e-12;
constexpr int scan_points = 61;  // five a decade

class PaddedTransform {
 public:
  explicit PaddedTransform(std::size_t record_size)
      : fft_(fast_transform_size(2 * record_size)), time_(fft_.size()), spectrum_(fft_.spectrum_size()) {}

  ComplexBuffer forward(std::span<const double> x) {
    std::ranges::fill(time_, 0.0);
    std::ranges::copy(x, time_.begin());
    fft_.forward(time_, spectrum_);
    return spectrum_;
  }
  std::vector<double> inverse(ComplexBuffer& spectrum, std::size_t count) {
    fft_.inverse(spectrum, time_);
    return {time_.begin(), time_.begin() + static_cast<std::ptrdiff_t>(count)};
  }
  [[nodiscard]] std::size_t size() const { return fft_.size(); }

 private:
  RealFft fft_;
  RealBuffer time_;
  ComplexBuffer spectrum_;
};

/// Weight of frequency k in a sum over all of the transform.
double multiplicity(std::size_t k, std::size_t transform_size) { return k == 0 || 2 * k == transform_size ? 1 : 2; }

struct Fit {
  double residual = 0;            ///< Σ|V - X F|²
  double norm = 0;                ///< Σ penalty |X|²
  double degrees_of_freedom = 0;  ///< Σ S_ff/(S_ff + λ·penalty)
};

Fit fit(const AveragedSpectra& spectra, double lambda, Penalty penalty) {
  Fit sum;
  for (std::size_t k = 0; k < spectra.cross.size(); ++k) {
    const double power = spectra.input_power[k];
    if (!(power > 0)) continue;
    const double weight = multiplicity(k, spectra.transform_size);
    const double held = penalty_at(penalty, k, spectra.transform_size);
    const double kept = power / (power + lambda * held);
    const double cross = std::norm(spectra.cross[k]);
    // With X = S_fv/(S_ff + λ): S_vv - |S_fv|²/S_ff (1 - (1 - kept)²); the rest of S_vv is not to be had at any λ.
    sum.residual += weight * (spectra.output_power[k] - cross / power * kept * (2 - kept));
    sum.norm += weight * held * cross * kept * kept / (power * power);
    sum.degrees_of_freedom += weight * kept;
  }
  return sum;
}

double scanned(int index) { return std::pow(least_regularisation, 1 - static_cast<double>(index) / (scan_points - 1)); }

}  // namespace

double AveragedSpectra::largest_input_power() const { return *std::ranges::max_element(input_power); }

std::vector<double> AveragedSpectra::coherence() const {
  std::vector<double> coherence(cross.size());
  for (std::size_t k = 0; k < cross.size(); ++k) {
    const double powers = input_power[k] * output_power[k];
    if (powers > 0) coherence[k] = std::min(1.0, std::norm(cross[k]) / powers);
  }
  return coherence;
}

AveragedSpectra averaged_spectra(std::span<const InputOutput> records) {
  require_alike(records);
  const std::size_t size = records.front().input.size();
  PaddedTransform transform(size);
  const std::size_t half = transform.size() / 2 + 1;
  AveragedSpectra spectra{records.size(),
                          size,
                          transform.size(),
                          std::vector<double>(half),
                          std::vector<double>(half),
                          std::vector<Complex>(half)};
  for (const InputOutput& record : records) {
    const ComplexBuffer f = transform.forward(record.input);
    const ComplexBuffer v = transform.forward(record.output);
    for (std::size_t k = 0; k < half; ++k) {
      spectra.input_power[k] += std::norm(f[k]);
      spectra.output_power[k] += std::norm(v[k]);
      spectra.cross[k] += std::conj(f[k]) * v[k];
    }
  }
  require(spectra.largest_input_power() > 0, "the inputs are zero throughout, so they say nothing about the outputs");
  return spectra;
}

double cross_validated_regularisation(const AveragedSpectra& spectra, Penalty penalty) {
  const double largest = spectra.largest_input_power();
  const auto samples = static_cast<double>(spectra.record_count * spectra.transform_size);
  const auto score = [&](double log_relative) {
    const Fit at = fit(spectra, std::exp(log_relative) * largest, penalty);
    return at.residual / std::pow(samples - at.degrees_of_freedom, 2);
  };
  int best = 0;
  double least = HUGE_VAL;
  for (int k = 0; k < scan_points; ++k) {
    const double value = score(std::log(scanned(k)));
    if (value < least) {
      least = value;
      best = k;
    }
  }
  double low = std::log(scanned(std::max(best - 1, 0)));
  double high = std::log(scanned(std::min(best + 1, scan_points - 1)));
  const double golden = (std::sqrt(5.0) - 1) / 2;
  for (int k = 0; k < 12; ++k) {
    const double left = high - golden * (high - low);
    const double right = low + golden * (high - low);
    (score(left) < score(right) ? high : low) = score(left) < score(right) ? right : left;
  }
  return std::exp((low + high) / 2);
}

double l_curve_regularisation(const AveragedSpectra& spectra, Penalty penalty) {
  const double largest = spectra.largest_input_power();
  std::vector<double> x(scan_points);
  std::vector<double> y(scan_points);
  for (int k = 0; k < scan_points; ++k) {
    const Fit at = fit(spectra, scanned(k) * largest, penalty);
    x[static_cast<std::size_t>(k)] = std::log(at.residual);
    y[static_cast<std::size_t>(k)] = std::log(at.norm);
  }
  std::size_t best = 1;
  double sharpest = -HUGE_VAL;
  for (std::size_t k = 1; k + 1 < x.size(); ++k) {
    const double dx = (x[k + 1] - x[k - 1]) / 2;
    const double dy = (y[k + 1] - y[k - 1]) / 2;
    const double ddx = x[k + 1] - 2 * x[k] + x[k - 1];
    const double ddy = y[k + 1] - 2 * y[k] + y[k - 1];
    const double curvature = (dx * ddy - dy * ddx) / std::pow(dx * dx + dy * dy, 1.5);
    if (std::isfinite(curvature) && curvature > sharpest) {
      sharpest = curvature;
      best = k;
    }
  }
  return scanned(static_cast<int>(best));
}

namespace {

Complex estimate(SpectralEstimator estimator, double ff, double vv, Complex fv) {
  if (std::norm(fv) == 0) return 0;
  switch (estimator) {
    case SpectralEstimator::h1:
      return fv / ff;
    case SpectralEstimator::h2:
      return vv / std::conj(fv);
    case SpectralEstimator::hv:
      return std::sqrt(vv / ff) * fv / std::abs(fv);
  }
  return 0;
}

Complex regularised(SpectralEstimator estimator, double ff, double vv, Complex fv, double lambda) {
  return ff > 0 ? ff / (ff + lambda) * estimate(estimator, ff, vv, fv) : 0;
}

}  // namespace

EstimatedKernel spectral_kernel(std::span<const InputOutput> records, const AveragedSpectra& spectra,
                                SpectralEstimator estimator, double regularisation) {
  require(regularisation >= 0, "regularisation {} is negative", regularisation);
  const double lambda = regularisation * spectra.largest_input_power();
  PaddedTransform transform(spectra.record_size);
  const std::size_t half = spectra.cross.size();
  ComplexBuffer kernel(half);
  for (std::size_t k = 0; k < half; ++k) {
    const double power = spectra.input_power[k];
    require(power + lambda > 0, "no input has power at 1/{} of the sampling frequency; use a --regularisation",
            static_cast<double>(spectra.transform_size) / static_cast<double>(std::max<std::size_t>(k, 1)));
    kernel[k] = regularised(estimator, power, spectra.output_power[k], spectra.cross[k], lambda);
  }
  EstimatedKernel result{transform.inverse(kernel, spectra.record_size), {}, spectra.record_count - 1, 0};
  if (spectra.record_count == 1) return result;
  const auto count = static_cast<double>(records.size());
  // λ per record stays: the estimate is a function of the records' mean spectra.
  const double less_lambda = (count - 1) / count * lambda;
  for (const InputOutput& record : records) {
    const ComplexBuffer f = transform.forward(record.input);
    const ComplexBuffer v = transform.forward(record.output);
    ComplexBuffer without(half);
    for (std::size_t k = 0; k < half; ++k)
      without[k] = regularised(estimator, std::max(0.0, spectra.input_power[k] - std::norm(f[k])),
                               std::max(0.0, spectra.output_power[k] - std::norm(v[k])),
                               spectra.cross[k] - std::conj(f[k]) * v[k], less_lambda);
    result.deviations.push_back(transform.inverse(without, spectra.record_size));
  }
  for (std::size_t n = 0; n < spectra.record_size; ++n) {
    double mean = 0;
    for (const auto& without : result.deviations) mean += without[n] / count;
    for (auto& without : result.deviations) without[n] = std::sqrt((count - 1) / count) * (mean - without[n]);
  }
  return result;
}

}  // namespace impulse
