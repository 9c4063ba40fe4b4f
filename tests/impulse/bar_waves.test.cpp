#include "impulse/measured/bar_waves.hpp"

#include "impulse/contact/contact_equation.hpp"
#include "impulse/response/wave_response.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"
#include "tests/support/records.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

using namespace impulse;
using std::numbers::pi;

namespace {

const Material steel{"steel", 206e9, 7780, 0.29};
constexpr double diameter = 0.02;
constexpr double step = 5e-7;

/// A trapezium of 60 µs with rounded edges from `begin` on.
double pulse_at(double t, double begin) {
  const auto edge = [](double x) { return 0.5 * (1 + std::erf(x)); };
  return edge((t - begin - 8e-6) / 2e-6) * edge((begin + 60e-6 - t) / 2e-6);
}

StrainWave pulse(std::size_t size, double begin, double strain) {
  StrainWave wave{{step, size}, std::vector<double>(size)};
  for (std::size_t n = 0; n < size; ++n) wave.strain[n] = strain * pulse_at(static_cast<double>(n) * step, begin);
  return wave;
}

double largest(const std::vector<double>& x) {
  double most = 0;
  for (double value : x) most = std::max(most, std::abs(value));
  return most;
}
double difference(const std::vector<double>& x, const std::vector<double>& y) {
  double most = 0;
  for (std::size_t n = 0; n < x.size(); ++n) most = std::max(most, std::abs(x[n] - y[n]));
  return most;
}

}  // namespace

TEST_CASE("bar_waves: a pulse after 100 diameters is an independent Fourier sum, and back it returns") {
  const StrainWave wave = pulse(4096, 200e-6, -1e-3);
  const WaveBar bar(steel, diameter, Dispersion::pochhammer_chree, step);
  const StrainWave far = travelled(wave, bar, 100 * diameter);
  // The pulse as a Fourier series of another period, its coefficients by direct summation, every phase velocity by its
  // own root. The spectrum of an edge of 2 µs, e^(-(ω 1 µs)²), is below 1e-13 of the pulse at 1 MHz.
  const double period = 3.3e-3;
  std::vector<double> sum(4096);
  for (int k = 0; k * 1.0 / period < 1.0e6; ++k) {
    const double omega = 2 * pi * k / period;
    std::complex<double> coefficient = 0;
    for (std::size_t n = 0; n < 4096; ++n)
      if (wave.strain[n] != 0) coefficient += std::polar(wave.strain[n], -omega * static_cast<double>(n) * step);
    coefficient *= (k == 0 ? 1.0 : 2.0) * step / period;
    if (std::abs(coefficient) < 1e-13) continue;
    // κ with κ c(κ)/c0 = Ω by fixed-point iteration on the exact curve.
    const double target = omega * diameter / 2 / steel.rod_wave_speed_m_per_s();
    double kappa = target;
    for (int pass = 0; pass < 200; ++pass) {
      const double next = target / pochhammer_chree_speed_ratio(kappa, 0.29);
      const bool settled = std::abs(next - kappa) < 1e-13 * (1 + kappa);
      kappa = settled ? next : 0.5 * (kappa + next);
      if (settled) break;
    }
    const double phase = kappa / (diameter / 2) * 100 * diameter;
    for (std::size_t n = 0; n < 4096; n += 7)
      sum[n] += (coefficient * std::polar(1.0, omega * static_cast<double>(n) * step - phase)).real();
  }
  double error = 0;
  for (std::size_t n = 0; n < 4096; n += 7) error = std::max(error, std::abs(far.strain[n] - sum[n]));
  CHECK(error < 1e-6 * 1e-3);
  CHECK(difference(far.strain, wave.strain) > 0.5e-3);
  const StrainWave back = travelled(far, bar, -100 * diameter);
  CHECK(difference(back.strain, wave.strain) < 1e-6 * 1e-3);
}

TEST_CASE("bar_waves: without dispersion travelling is a delay, force and velocity are EAε and c0 ε") {
  const WaveBar bar(steel, diameter, Dispersion::none, step);
  const double c0 = std::sqrt(206e9 / 7780);
  CHECK(bar.phase_velocity_m_per_s(1e5) == about(c0));
  const StrainWave wave = pulse(2048, 200e-6, -1e-3);
  const StrainWave later = travelled(wave, bar, 100 * step * c0);
  for (std::size_t n = 100; n < 2048; ++n) CHECK(std::abs(later.strain[n] - wave.strain[n - 100]) < 1e-12);
  const std::vector<double> force = wave_force_N(wave, bar);
  const std::vector<double> velocity = wave_velocity_m_per_s(wave, bar);
  CHECK(largest(force) == about(206e9 * pi * 1e-4 * 1e-3).epsilon(1e-4));
  for (std::size_t n = 0; n < 2048; ++n)
    CHECK(std::abs(force[n] - bar.impedance_kg_per_s() * velocity[n]) < 1e-9 * largest(force));
  CHECK(difference(strain_of_force({wave.grid, force}, bar).strain, wave.strain) < 1e-15);
}

TEST_CASE("bar_waves: dispersion keeps momentum, and force and strain undo each other") {
  const WaveBar bar(steel, diameter, Dispersion::pochhammer_chree, step);
  const StrainWave wave = pulse(4096, 300e-6, -1e-3);
  const auto momentum = [&](const StrainWave& w) {
    double sum = 0;
    for (double value : wave_force_N(w, bar)) sum += value * step;
    return sum;
  };
  const StrainWave far = travelled(wave, bar, 3);
  CHECK(momentum(far) == about(momentum(wave)).epsilon(1e-6));  // the slowest frequencies are beyond the record
  CHECK(difference(strain_of_force({wave.grid, wave_force_N(wave, bar)}, bar).strain, wave.strain) < 1e-9 * 1e-3);
}

TEST_CASE("bar_waves: one gauge and two gauges find the waves at the end") {
  for (Dispersion dispersion : {Dispersion::none, Dispersion::pochhammer_chree}) {
    const WaveBar bar(steel, diameter, dispersion, step);
    const StrainWave arriving = pulse(4096, 500e-6, -1e-3);
    StrainWave leaving = pulse(4096, 520e-6, 0.6e-3);
    const auto gauge = [&](double distance) {
      StrainWave sum = travelled(arriving, bar, -distance);
      const StrainWave back = travelled(leaving, bar, distance);
      for (std::size_t n = 0; n < 4096; ++n) sum.strain[n] += back.strain[n];
      return sum;
    };
    const EndWaves one = separated_at(gauge(1.0), bar, 1.0, 500e-6);
    // Dispersed, the two pulses are apart but for the tails at the split.
    const double tail = dispersion == Dispersion::none ? 1e-9 : 1e-2;
    CHECK(difference(one.arriving.strain, arriving.strain) < tail * 1e-3);
    CHECK(difference(one.leaving.strain, leaving.strain) < tail * 1e-3);
    // Two gauges, in either order: at 0.1 m the pulses overlap. With dispersion, travelled() is as good as its
    // table of phase velocities, and the passages sum its errors up.
    const double accuracy = dispersion == Dispersion::none ? 1e-12 : 1e-8;
    for (const EndWaves& two : {separated_by_two(gauge(0.1), gauge(0.43), bar, 0.1, 0.43),
                                separated_by_two(gauge(0.43), gauge(0.1), bar, 0.43, 0.1)}) {
      CHECK(difference(two.arriving.strain, arriving.strain) < accuracy * 1e-3);
      CHECK(difference(two.leaving.strain, leaving.strain) < accuracy * 1e-3);
    }
  }
}

namespace {

/// Waves at one end of a short bar in which a pulse goes to and fro, half of it after every round.
EndWaves reverberation(const WaveBar& bar, std::size_t size) {
  EndWaves end{pulse(size, 600e-6, -1e-3), {{step, size}, std::vector<double>(size)}};
  StrainWave round = end.arriving;
  const auto add = [](const StrainWave& wave, double factor, StrainWave& sum) {
    for (std::size_t n = 0; n < sum.strain.size(); ++n) sum.strain[n] += factor * wave.strain[n];
  };
  double factor = 1;
  for (int echo = 0; echo < 20; ++echo) {
    add(round, -0.75 * factor, end.leaving);
    round = travelled(round, bar, 2 * 0.6);
    factor *= 0.5;
    add(round, factor, end.arriving);
  }
  return end;
}

StrainWave at_gauge(const EndWaves& end, const WaveBar& bar, double distance) {
  StrainWave sum = travelled(end.arriving, bar, -distance);
  const StrainWave back = travelled(end.leaving, bar, distance);
  for (std::size_t n = 0; n < sum.strain.size(); ++n) sum.strain[n] += back.strain[n];
  return sum;
}

}  // namespace

// Over 4 ms the waves pass between the gauges 69 times; 0.15 m is half a wave for frequencies from 17 kHz on.
TEST_CASE("bar_waves: two gauges follow a bar that rings, with dispersion, through all of its echoes") {
  const WaveBar bar(steel, diameter, Dispersion::pochhammer_chree, step);
  const EndWaves end = reverberation(bar, 8192);
  const EndWaves found = separated_by_two(at_gauge(end, bar, 0.15), at_gauge(end, bar, 0.3), bar, 0.15, 0.3);
  // From 600 us on, so that the slowest waves of the first pulse pass the far gauge within the record. The slowest of
  // what leaves the end in the last 80 us, 160 samples, have not come to the near one, and blur what is before.
  for (std::size_t n = 0; n < 8192 - 500; ++n) {
    REQUIRE(std::abs(found.arriving.strain[n] - end.arriving.strain[n]) < 1e-6 * 1e-3);
    REQUIRE(std::abs(found.leaving.strain[n] - end.leaving.strain[n]) < 1e-6 * 1e-3);
  }
}

TEST_CASE("bar_waves: noise of two gauges adds up over the passages between them") {
  const WaveBar bar(steel, diameter, Dispersion::none, step);
  std::mt19937_64 engine(3);
  const double passage = 2 * 0.33 / bar.wave_speed_m_per_s();
  double early = 0, late = 0;  // variance of the arriving wave after 2 and after 12 passages
  for (int repetition = 0; repetition < 8; ++repetition) {
    const StrainWave one{{step, 4096}, records::noise(4096, 1, engine)};
    const StrainWave two{{step, 4096}, records::noise(4096, 1, engine)};
    const std::vector<double> arriving = separated_by_two(one, two, bar, 0.1, 0.43).arriving.strain;
    const auto variance = [&](double passages) {
      const auto middle = static_cast<std::size_t>((passages * passage + 0.43 / bar.wave_speed_m_per_s()) / step);
      double sum = 0;
      for (std::size_t n = middle; n < middle + 100; ++n) sum += arriving[n] * arriving[n] / 100;
      return sum / 8;
    };
    early += variance(2);
    late += variance(12);
  }
  // After n passages and before the next half ε_far has come n + 1 times, ε_near n times. Known to 5 %.
  CHECK(early == about(5).epsilon(0.15));
  CHECK(late == about(25).epsilon(0.15));
}

TEST_CASE("bar_waves: no group of waves is slower than a third of c0, so that four record lengths hold the passages") {
  for (const double nu : {0.2, 0.29, 0.33, 0.5}) {
    double before = 0;
    for (double kappa = 0.02; kappa < 12; kappa += 0.02) {
      const double omega = kappa * pochhammer_chree_speed_ratio(kappa, nu);
      CHECK(omega - before > 0.02 / 3);
      before = omega;
    }
  }
}

TEST_CASE("bar_waves: a free end has no force and twice the velocity") {
  const WaveBar bar(steel, diameter, Dispersion::pochhammer_chree, step);
  const StrainWave arriving = pulse(4096, 500e-6, -1e-3);
  StrainWave leaving = arriving;
  for (double& value : leaving.strain) value = -value;
  const EndWaves end{arriving, leaving};
  CHECK(largest(end.force_N(bar)) < 1e-9 * largest(wave_force_N(arriving, bar)));
  CHECK(largest(end.velocity_m_per_s(bar)) == about(2 * largest(wave_velocity_m_per_s(arriving, bar))));
}

TEST_CASE("bar_waves: the striker's speed comes back from the force that the contact equation predicts") {
  const Bar striker{{{0.3, 0.016, 0.016, steel}}, {Face::b}, FarEnd::free};
  const Bar rod{{{4, diameter, diameter, steel}}, {Face::a}, FarEnd::infinite};
  const UniformGrid grid{step, 1200};
  const ImpactHistory history =
      solve_contact(wave_response(striker, grid), wave_response(rod, grid), {7.5}, ContactMethod::product);
  UniformSeries delayed{grid, std::vector<double>(1200)};  // a pulse in a record begins after it
  for (std::size_t n = 40; n < 1200; ++n) delayed.values[n] = history.force_N[n - 40];
  const double z_striker = face_impedance_kg_per_s(striker.profile, Face::b);
  const double z_bar = face_impedance_kg_per_s(rod.profile, Face::a);
  const StrikerPulse found = striker_pulse(delayed, z_striker, z_bar);
  CHECK(found.striker_speed_m_per_s == about(7.5).epsilon(1e-3));
  CHECK(found.begin_s == about(40 * step).epsilon(0.03));
  CHECK(found.length_s == about(2 * 0.3 / steel.rod_wave_speed_m_per_s()).epsilon(0.01));
}

TEST_CASE("bar_waves: bridge") {
  // Quarter bridge, k = 2, 10 V: 1 mV is 200 µstrain.
  CHECK(strain_per_volt({2, 10, 1, 1}) * 1e-3 == about(200e-6));
  CHECK(strain_per_volt({2, 10, 100, 2}) == about(1e-3));
  CHECK_THROWS_WITH_AS((void)strain_per_volt({0, 10, 1, 1}), doctest::Contains("must be positive"),
                       std::invalid_argument);
}

TEST_CASE("bar_waves: refusals") {
  Material plain = steel;
  plain.poissons_ratio.reset();
  CHECK_THROWS_WITH_AS(WaveBar(plain, diameter, Dispersion::pochhammer_chree, step),
                       doctest::Contains("no Poisson's ratio"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(WaveBar(steel, 0, Dispersion::none, step), doctest::Contains("diameter"), std::invalid_argument);
  const WaveBar bar(steel, diameter, Dispersion::none, step);
  const StrainWave wave = pulse(100, 1e-5, 1);
  CHECK_THROWS_WITH_AS((void)separated_at(wave, bar, 1, 1), doctest::Contains("outside the record"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)separated_by_two(wave, wave, bar, 1, 1), doctest::Contains("must stand apart"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)separated_by_two(wave, pulse(99, 1e-5, 1), bar, 1, 2),
                       doctest::Contains("different grids"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)striker_pulse({{1, 3}, {0, 0, 0}}, 1, 1), doctest::Contains("no pulse"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)striker_pulse({{1, 3}, {0, 1, 2}}, 1, 1), doctest::Contains("end of the record"),
                       std::invalid_argument);
}
