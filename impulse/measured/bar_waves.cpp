#include "impulse/measured/bar_waves.hpp"

#include "lib/contract/require.hpp"
#include "lib/transform/real_fft.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace impulse {
namespace {

using Complex = std::complex<double>;

/// A transform of a record with zeros behind it, to `lengths` times its length, and the frequencies that belong to it.
class WaveTransform {
 public:
  explicit WaveTransform(const UniformGrid& grid, std::size_t lengths = 2)
      : grid_(grid), fft_(fast_transform_size(lengths * grid.size)), time_(fft_.size()) {}

  [[nodiscard]] ComplexBuffer forward(const std::vector<double>& values) {
    std::ranges::fill(time_, 0.0);
    std::ranges::copy(values, time_.begin());
    ComplexBuffer spectrum(fft_.spectrum_size());
    fft_.forward(time_, spectrum);
    return spectrum;
  }
  [[nodiscard]] std::vector<double> inverse(ComplexBuffer& spectrum) {
    fft_.inverse(spectrum, time_);
    return {time_.begin(), time_.begin() + static_cast<std::ptrdiff_t>(grid_.size)};
  }
  [[nodiscard]] double angular_frequency(std::size_t k) const {
    return 2 * std::numbers::pi * static_cast<double>(k) / (static_cast<double>(fft_.size()) * grid_.step_s);
  }

 private:
  UniformGrid grid_;
  RealFft fft_;
  RealBuffer time_;
};

/// The series times a real function of the phase velocity at each frequency.
template <class Factor>
std::vector<double> filtered(const UniformGrid& grid, const std::vector<double>& values, const WaveBar& bar,
                             Factor factor) {
  WaveTransform transform(grid);
  ComplexBuffer spectrum = transform.forward(values);
  for (std::size_t k = 0; k < spectrum.size(); ++k)
    spectrum[k] *= factor(bar.phase_velocity_m_per_s(transform.angular_frequency(k)));
  return transform.inverse(spectrum);
}

/// Σ e^(-imθ) over m = 0 .. count-1.
Complex sum_of_powers(double theta, double count) {
  const double half = std::remainder(theta, 2 * std::numbers::pi) / 2;
  // Below, the sum is `count` to rounding.
  const double amplitude = std::abs(count * half) < 1e-8 ? count : std::sin(count * half) / std::sin(half);
  return std::polar(1.0, -(count - 1) * half) * amplitude;
}

std::vector<double> combined(const std::vector<double>& a, double sign, const std::vector<double>& b) {
  std::vector<double> sum(a.size());
  for (std::size_t n = 0; n < a.size(); ++n) sum[n] = a[n] + sign * b[n];
  return sum;
}

}  // namespace

WaveBar::WaveBar(const Material& material, double diameter_m, Dispersion dispersion, double step_s)
    : c0_(material.rod_wave_speed_m_per_s()),
      density_(material.density_kg_per_m3),
      area_(std::numbers::pi / 4 * diameter_m * diameter_m),
      radius_(diameter_m / 2) {
  require(diameter_m > 0, "the bar's diameter {} m is not positive", diameter_m);
  require(step_s > 0, "the step {} s is not positive", step_s);
  if (dispersion == Dispersion::none) return;
  require(material.poissons_ratio.has_value(),
          "{} has no Poisson's ratio, which dispersion depends on; add it ({}:0.29) or leave dispersion out",
          material.name, material.name);
  // To the Nyquist frequency, and a rounding beyond.
  table_.emplace(*material.poissons_ratio, 1.001 * std::numbers::pi / step_s * radius_ / c0_);
}

double WaveBar::phase_velocity_m_per_s(double angular_frequency) const {
  return table_ ? c0_ * table_->speed_ratio(angular_frequency * radius_ / c0_) : c0_;
}

StrainWave travelled(const StrainWave& wave, const WaveBar& bar, double distance_m) {
  WaveTransform transform(wave.grid);
  ComplexBuffer spectrum = transform.forward(wave.strain);
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    const double omega = transform.angular_frequency(k);
    spectrum[k] *= std::polar(1.0, -omega * distance_m / bar.phase_velocity_m_per_s(omega));
  }
  return {wave.grid, transform.inverse(spectrum)};
}

std::vector<double> wave_force_N(const StrainWave& wave, const WaveBar& bar) {
  const double inertia = bar.density_kg_per_m3() * bar.area_m2();
  return filtered(wave.grid, wave.strain, bar, [&](double c) { return -inertia * c * c; });
}

StrainWave strain_of_force(const UniformSeries& force_N, const WaveBar& bar) {
  const double inertia = bar.density_kg_per_m3() * bar.area_m2();
  return {force_N.grid, filtered(force_N.grid, force_N.values, bar, [&](double c) { return -1 / (inertia * c * c); })};
}

std::vector<double> wave_velocity_m_per_s(const StrainWave& wave, const WaveBar& bar) {
  return filtered(wave.grid, wave.strain, bar, [](double c) { return -c; });
}

std::vector<double> EndWaves::force_N(const WaveBar& bar) const {
  return combined(wave_force_N(arriving, bar), 1, wave_force_N(leaving, bar));
}

std::vector<double> EndWaves::velocity_m_per_s(const WaveBar& bar) const {
  return combined(wave_velocity_m_per_s(arriving, bar), -1, wave_velocity_m_per_s(leaving, bar));
}

EndWaves separated_at(const StrainWave& gauge, const WaveBar& bar, double distance_m, double split_s) {
  require(split_s > 0 && split_s < gauge.grid.duration_s(), "the split at {} s lies outside the record, 0 .. {} s",
          split_s, gauge.grid.duration_s());
  StrainWave arriving = gauge;
  StrainWave leaving = gauge;
  const auto split = static_cast<std::ptrdiff_t>(std::lround(split_s / gauge.grid.step_s));
  std::fill(arriving.strain.begin() + split, arriving.strain.end(), 0.0);
  std::fill(leaving.strain.begin(), leaving.strain.begin() + split, 0.0);
  return {travelled(arriving, bar, distance_m), travelled(leaving, bar, -distance_m)};
}

EndWaves separated_by_two(const StrainWave& gauge_1, const StrainWave& gauge_2, const WaveBar& bar, double distance_1_m,
                          double distance_2_m) {
  require(distance_1_m != distance_2_m, "both gauges are {} m from the end; they must stand apart", distance_1_m);
  require(same_grid(gauge_1.grid, gauge_2.grid), "the gauges have different grids");
  const bool first_is_near = distance_1_m < distance_2_m;
  const double near_m = std::min(distance_1_m, distance_2_m);
  const double far_m = std::max(distance_1_m, distance_2_m);
  // What begins in the record and is late by its length at c0 is over before four lengths are, because no group is
  // slower than c0/3 (for ν ≥ 0.2; below, it is those near κ = 2.3 alone).
  WaveTransform transform(gauge_1.grid, 4);
  const ComplexBuffer near = transform.forward((first_is_near ? gauge_1 : gauge_2).strain);
  const ComplexBuffer far = transform.forward((first_is_near ? gauge_2 : gauge_1).strain);
  const double reach_m = bar.wave_speed_m_per_s() * gauge_1.grid.duration_s() + near_m;
  const double passages = std::ceil(reach_m / (2 * (far_m - near_m))) + 1;
  ComplexBuffer arriving(near.size());
  ComplexBuffer leaving(near.size());
  for (std::size_t k = 0; k < near.size(); ++k) {
    const double omega = transform.angular_frequency(k);
    const double wave_number = omega / bar.phase_velocity_m_per_s(omega);
    const auto over = [&](double distance_m) { return std::polar(1.0, -wave_number * distance_m); };
    const Complex sum = sum_of_powers(2 * wave_number * (far_m - near_m), passages);
    arriving[k] = (far[k] * over(far_m) - near[k] * over(2 * far_m - near_m)) * sum;
    leaving[k] = (near[k] * over(-near_m) - far[k] * over(far_m - 2 * near_m)) * sum;
  }
  return {{gauge_1.grid, transform.inverse(arriving)}, {gauge_1.grid, transform.inverse(leaving)}};
}

double strain_per_volt(const StrainBridge& bridge) {
  require(bridge.gauge_factor > 0 && bridge.excitation_V > 0 && bridge.gain > 0 && bridge.active_arms > 0,
          "gauge factor {}, excitation {} V, gain {} and active arms {} must be positive", bridge.gauge_factor,
          bridge.excitation_V, bridge.gain, bridge.active_arms);
  return 4 / (bridge.gauge_factor * bridge.excitation_V * bridge.gain * bridge.active_arms);
}

namespace {

/// Where a straight line between two samples crosses the level.
double crossing_s(const UniformSeries& series, std::size_t before, double level) {
  const double a = series.values[before];
  const double b = series.values[before + 1];
  return series.grid.step_s * (static_cast<double>(before) + (level - a) / (b - a));
}

struct Crossings {
  double first_s = 0;
  double last_s = 0;
};

/// The crossings of a level on both sides of sample `inside`.
Crossings crossings(const UniformSeries& series, std::size_t inside, double level) {
  const std::vector<double>& x = series.values;
  std::size_t first = inside;
  while (first > 0 && x[first] > level) --first;
  std::size_t last = inside;
  while (last + 1 < x.size() && x[last] > level) ++last;
  require(x[first] <= level && x[last] <= level,
          "the pulse reaches the end of the record: it cannot be measured; give more of the record");
  return {crossing_s(series, first, level), crossing_s(series, last - 1, level)};
}

}  // namespace

StrikerPulse striker_pulse(const UniformSeries& force_N, double striker_impedance_kg_per_s,
                           double bar_impedance_kg_per_s) {
  const auto peak = std::ranges::max_element(force_N.values);
  const auto least = std::ranges::min_element(force_N.values);
  require(peak != force_N.values.end() && *peak > -0.01 * *least && *peak > 0,
          "the force is nowhere compressive: there is no pulse in it; mind the sign");
  const auto at_peak = static_cast<std::size_t>(peak - force_N.values.begin());
  StrikerPulse pulse{.plateau_force_N = *peak};
  // The plateau is known once the pulse is, and the other way round; overshoot makes the peak a first guess only.
  for (int pass = 0; pass < 3; ++pass) {
    const Crossings half = crossings(force_N, at_peak, pulse.plateau_force_N / 2);
    pulse.begin_s = half.first_s;
    pulse.length_s = half.last_s - half.first_s;
    const auto first = static_cast<std::ptrdiff_t>((half.first_s + pulse.length_s / 4) / force_N.grid.step_s) + 1;
    const auto last = static_cast<std::ptrdiff_t>((half.last_s - pulse.length_s / 4) / force_N.grid.step_s) + 1;
    require(last > first, "the pulse is {} s long: too few samples for its plateau", pulse.length_s);
    pulse.plateau_force_N = std::accumulate(force_N.values.begin() + first, force_N.values.begin() + last, 0.0) /
                            static_cast<double>(last - first);
  }
  pulse.striker_speed_m_per_s = pulse.plateau_force_N * (1 / striker_impedance_kg_per_s + 1 / bar_impedance_kg_per_s);
  return pulse;
}

}  // namespace impulse
