#include "impulse/response/wave_response.hpp"

#include "impulse/response/pulse_train.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"
#include "tests/support/wave_lattice.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace impulse;

namespace {

/// A segment that a wave crosses in `cells` steps of `step_s`.
Segment segment_by_time(double cells, double step_s, double d1, double d2, const char* material) {
  const Material m = parse_material(material);
  return {cells * step_s * m.rod_wave_speed_m_per_s(), d1, d2, m};
}

/// Relative L2 difference of H from the lattice at odd steps, where no front arrives (all of them come after an even
/// number).
double difference_from_lattice(const Profile& profile, double step_s, std::size_t size) {
  const std::vector<double> expected = lattice::step_velocity(profile, step_s, size);
  const Response response = wave_response({profile, {Face::a}, FarEnd::free}, {step_s, size});
  const std::vector<double>& h = response.pair(0, 0).step_velocity_m_per_Ns;
  double difference = 0;
  double norm = 0;
  for (std::size_t k = 1; k < size; k += 2) {
    difference += std::pow(h[k] - expected[k], 2);
    norm += std::pow(expected[k], 2);
  }
  return std::sqrt(difference / norm);
}

}  // namespace

TEST_CASE(
    "wave_response: a cylinder's step velocity is the staircase of its echoes, whether they fall on samples or not") {
  for (double step : {1e-6, 0.37e-6}) {
    const UniformGrid grid = grid_over(1e-3, step);
    const auto check = [&](FarEnd far_end, double sign) {
      const Bar bar = bars::steel_rod(0.5, far_end);
      const double z = face_impedance_kg_per_s(bar.profile, Face::a);
      const double round_trip = 2 * travel_time_s(bar.profile);
      const Response response = wave_response(bar, grid);
      for (std::size_t k = 0; k < grid.size; ++k) {
        const double t = grid.time_s(k);
        const double echoes = std::floor(t / round_trip);
        // Pulses 1, 2s, 2s², ... over Z.
        double h = 1, u = t;
        double power = 1;
        for (double n = 1; n <= echoes; ++n) {
          power *= sign;
          h += 2 * power;
          u += 2 * power * (t - n * round_trip);
        }
        CHECK(response.pair(0, 0).step_velocity_m_per_Ns[k] == about(h / z).epsilon(1e-12));
        // One rounding a sample: size·ε of the record's length.
        CHECK(std::abs(response.pair(0, 0).step_displacement_m_per_N[k] - u / z) < 1e-12 * grid.duration_s() / z);
        CHECK(response.pair(0, 0).impulse_response_per_kg[k] == 0);
      }
    };
    check(FarEnd::free, 1);
    check(FarEnd::fixed, -1);
    check(FarEnd::infinite, 0);
  }
}

TEST_CASE("wave_response: a long cone answers with exp(-κt)/Z until its echo") {
  for (Face face : {Face::a, Face::b}) {
    const Bar bar = bars::cone(face);
    const Segment& s = bar.profile.front();
    const double z = face_impedance_kg_per_s(bar.profile, face);
    const double slope = (s.diameter_b_m - s.diameter_a_m) / s.length_m;
    const double kappa =
        s.material.rod_wave_speed_m_per_s() * (face == Face::a ? slope / s.diameter_a_m : -slope / s.diameter_b_m);
    const UniformGrid grid = grid_over(500e-6, 1e-6);
    const Response response = wave_response(bar, grid);
    for (std::size_t k = 0; k < grid.size; ++k) {
      const double t = grid.time_s(k);
      CHECK(std::abs(response.pair(0, 0).step_velocity_m_per_Ns[k] * z - std::exp(-kappa * t)) < 1e-10);
      CHECK(std::abs(response.pair(0, 0).step_displacement_m_per_N[k] * z * kappa - (1 - std::exp(-kappa * t))) <
            1e-10);
      CHECK(std::abs(response.pair(0, 0).impulse_response_per_kg[k] * z / kappa + std::exp(-kappa * t)) < 1e-7);
    }
  }
}

TEST_CASE("wave_response: random chains of cylinders agree with the lattice, which is exact for them") {
  std::mt19937 engine(11);
  std::uniform_int_distribution<int> cells(40, 400);
  std::uniform_real_distribution<double> diameter(0.01, 0.05);
  const char* materials[] = {"steel", "aluminium", "nylon-6"};
  for (int segments = 3; segments <= 7; ++segments) {
    CAPTURE(segments);
    Profile profile;
    for (int i = 0; i < segments; ++i) {
      const double d = diameter(engine);
      profile.push_back(segment_by_time(cells(engine), 1e-7, d, d, materials[i % 3]));
    }
    CHECK(difference_from_lattice(profile, 1e-7, 6001) < 1e-9);
  }
}

TEST_CASE("wave_response: seven incommensurate cylinders, so many fronts that the small ones go to a lattice") {
  // Travel times in prime numbers of 25 ns, so that fronts hardly ever merge. The oracle holds each segment's waves in
  // two delay lines: exact for cylinders, and its cost does not depend on the number of fronts.
  const double tick = 25e-9;
  const std::size_t cells[] = {1361, 1747, 2411, 1523, 1933, 2179, 1669};
  const double diameters[] = {0.02, 0.035, 0.015, 0.03, 0.022, 0.04, 0.018};
  const char* materials[] = {"steel", "nylon-6", "aluminium", "steel", "nylon-6", "aluminium", "steel"};
  Profile profile;
  std::vector<double> z;
  std::vector<std::vector<double>> right, left;
  for (int i = 0; i < 7; ++i) {
    profile.push_back(segment_by_time(static_cast<double>(cells[i]), tick, diameters[i], diameters[i], materials[i]));
    z.push_back(profile.back().impedance_a_kg_per_s());
    right.emplace_back(cells[i], 0.0);
    left.emplace_back(cells[i], 0.0);
  }
  const UniformGrid grid{1e-6, 3001};
  const Response response = wave_response({profile, {Face::a}, FarEnd::free}, grid);
  double difference = 0, norm = 0;
  for (std::size_t k = 0; k < 3000 * 40; ++k) {
    const auto slot = [&](int i) { return k % cells[i]; };
    std::vector<double> to_right(7), to_left(7);
    to_right[0] = 1 / z[0] + left[0][slot(0)];
    to_left[6] = right[6][slot(6)];
    for (int i = 0; i < 6; ++i) {
      const double a = right[static_cast<std::size_t>(i)][slot(i)],
                   b = left[static_cast<std::size_t>(i) + 1][slot(i + 1)];
      const double za = z[static_cast<std::size_t>(i)], zb = z[static_cast<std::size_t>(i) + 1];
      to_left[static_cast<std::size_t>(i)] = ((za - zb) * a + 2 * zb * b) / (za + zb);
      to_right[static_cast<std::size_t>(i) + 1] = (2 * za * a + (zb - za) * b) / (za + zb);
    }
    // The velocity between this tick and the next, half a tick off every arrival; compared where the sample lies just
    // before.
    const double velocity = to_right[0] + left[0][slot(0)];
    if (k % 40 == 0 && k > 0) {
      difference += std::pow(response.pair(0, 0).step_velocity_m_per_Ns[k / 40] - velocity, 2);
      norm += velocity * velocity;
    }
    for (int i = 0; i < 7; ++i) {
      right[static_cast<std::size_t>(i)][slot(i)] = to_right[static_cast<std::size_t>(i)];
      left[static_cast<std::size_t>(i)][slot(i)] = to_left[static_cast<std::size_t>(i)];
    }
  }
  CHECK(std::sqrt(difference / norm) < 2e-3);  // samples next to an arrival included
  CHECK(pulse_train(wave_line(profile, FarEnd::free), grid.duration_s(), grid.step_s, 0).at_struck_end.size() > 5000);
}

TEST_CASE("wave_response: a cone on a cone agrees with the lattice extrapolated to zero step") {
  const auto profile = [](double cells, double step) {
    return Profile{segment_by_time(2 * cells, step, 0.03, 0.06, "nylon-6"),
                   segment_by_time(cells, step, 0.05, 0.02, "aluminium")};
  };
  // Two lattices of one chain, compared midway between the arrivals (every 4 µs) at samples even in both, as their
  // errors alternate.
  const double total = 600e-6;
  const auto lattice_at = [&](double step) {
    return lattice::step_velocity(profile(80e-6 / step, step), step,
                                  static_cast<std::size_t>(std::lround(total / step)) + 1);
  };
  const std::vector<double> coarse = lattice_at(1e-6);
  const std::vector<double> fine = lattice_at(0.5e-6);
  const Response response = wave_response({profile(80, 1e-6), {Face::a}, FarEnd::free}, {2e-6, 301});
  double largest = 0, smallest_ratio = HUGE_VAL, largest_ratio = 0;
  for (std::size_t k = 1; k < 301; k += 2) {
    const double h = response.pair(0, 0).step_velocity_m_per_Ns[k];
    largest = std::max(largest, std::abs((4 * fine[4 * k] - coarse[2 * k]) / 3 - h));
    smallest_ratio = std::min(smallest_ratio, (coarse[2 * k] - h) / (fine[4 * k] - h));
    largest_ratio = std::max(largest_ratio, (coarse[2 * k] - h) / (fine[4 * k] - h));
  }
  CHECK(largest < 1e-6 * 7.9e-4);  // 1/Z
  // The lattice converges to this response, with order 2.
  CHECK(smallest_ratio > 3.98);
  CHECK(largest_ratio < 4.02);
}

TEST_CASE("wave_response: rigid-body limit, reciprocity and causality of a chain with a cone") {
  Bar bar{{parse_segment("200mm,30mm,60mm,nylon-6"), parse_segment("150mm,40mm,aluminium")},
          {Face::a, Face::b},
          FarEnd::free};
  const UniformGrid grid = grid_over(20e-3, 5e-6);
  const Response response = wave_response(bar, grid);
  CHECK(response.pair(0, 1).step_displacement_m_per_N == response.pair(1, 0).step_displacement_m_per_N);
  const double m = mass_kg(bar.profile);
  const double t = grid.duration_s();
  for (std::size_t i : {0u, 1u})
    for (std::size_t j : {0u, 1u}) {
      const double rigid = (i == j ? 0.5 : -0.5) * t * t / m;
      // What is left is elastic displacement, bounded by the bar's compliance.
      CHECK(std::abs(response.pair(i, j).step_displacement_m_per_N.back() / rigid - 1) < 2e-4);
    }
  const auto arrival = static_cast<std::size_t>(travel_time_s(bar.profile) / grid.step_s);
  for (std::size_t k = 0; k <= arrival; ++k)
    CHECK(std::abs(response.pair(0, 1).step_displacement_m_per_N[k]) < 1e-20 + 1e-12 * t * t / m);
  std::swap(bar.faces[0], bar.faces[1]);
  const Response swapped = wave_response(bar, grid);
  double largest = 0;
  for (std::size_t k = 0; k < grid.size; ++k)
    largest = std::max(largest, std::abs(swapped.pair(0, 1).step_displacement_m_per_N[k] -
                                         response.pair(0, 1).step_displacement_m_per_N[k]));
  CHECK(largest < 1e-10 * 0.5 * t * t / m);
}

TEST_CASE("pulse_train: fronts are merged, so that their number stays polynomial") {
  const PulseTrain train = pulse_train(wave_line(bars::composite().profile, FarEnd::free), 2e-3, 1e-6, 0);
  // Two kinds of segment: at most one arrival for each pair of numbers of crossings.
  CHECK(train.at_struck_end.size() < 2e-3 / 160.2e-6 * 2e-3 / 49.4e-6);
  CHECK(train.at_struck_end.size() > 50);
}

TEST_CASE("wave_response: a bar whose echo comes 10^5 records later answers with 1/Z") {
  const Bar bar = bars::steel_rod(1e5);
  const Response response = wave_response(bar, grid_over(4e-6, 1e-6));
  const double z = face_impedance_kg_per_s(bar.profile, Face::a);
  for (double h : response.pair(0, 0).step_velocity_m_per_Ns) CHECK(h * z == about(1).epsilon(1e-14));
}

TEST_CASE("wave_response: refuses a cone too sharp to resolve") {
  Bar bar = bars::steel_rod(1);
  bar.profile[0].diameter_b_m = 1e-12;
  CHECK_THROWS_WITH_AS(static_cast<void>(wave_response(bar, grid_over(2e-3, 1e-6))),
                       doctest::Contains("use a blunter end"), std::invalid_argument);
}

TEST_CASE("wave_response: refuses what is not a bar") {
  CHECK_THROWS_WITH_AS(static_cast<void>(wave_response({{}, {Face::a}, FarEnd::free}, {1e-6, 10})),
                       doctest::Contains("segment"), std::invalid_argument);
}
