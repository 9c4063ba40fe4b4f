#include "impulse/contact/contact_equation.hpp"

#include "impulse/exact/bar_modes.hpp"
#include "impulse/exact/cone_impact.hpp"
#include "impulse/response/mass_response.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/wave_response.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"
#include "tests/support/direct_sums.hpp"
#include "tests/support/two_delay_impact.hpp"

#include <doctest/doctest.h>

using namespace impulse;

namespace {

ImpactHistory by_waves(const Bar& projectile, const Bar& target, double speed, const UniformGrid& grid,
                       ContactMethod method = ContactMethod::product) {
  return solve_contact(wave_response(projectile, grid), wave_response(target, grid), {speed}, method);
}

/// Exact modes up to the Nyquist frequency of the step, the resolution that the trapezoidal rule asks for.
Response modal(const Bar& bar, const UniformGrid& grid) {
  return modal_response(exact_bar_modes(bar, {.highest_frequency_Hz = (0.5 + 1e-9) / grid.step_s}), grid);
}

double sample(const ImpactHistory& history, double time_s) {
  return history.force_N[static_cast<std::size_t>(std::lround(time_s / history.grid.step_s))];
}

/// A smooth kernel without jumps: an elastic body of a few modes on a mass, with a residual flexibility if asked for.
Response smooth_response(const UniformGrid& grid, double residual) {
  ModalModel body{Eigen::VectorXd(4), Eigen::VectorXd::Constant(4, 0.01), Eigen::MatrixXd::Ones(4, 1),
                  Eigen::MatrixXd::Constant(1, 1, residual), Eigen::MatrixXd::Zero(1, 1)};
  body.angular_frequency << 0, 2000, 5000, 11000;
  body.damping_ratio(0) = 0;
  return modal_response(body, grid);
}

}  // namespace

TEST_CASE("contact_equation: TCA, exact values to the digits known") {
  const ImpactHistory tca = by_waves(bars::cone(), bars::long_rod(), 1.16, grid_over(1.1e-3, 1e-6));
  CHECK(tca.force_N[0] == about(1048.416001434).epsilon(1e-12));
  const double expected[][2] = {
      {118e-6, 1516.266007}, {355e-6, 2216.869017}, {545e-6, 1047.522209}, {782e-6, 672.485290}};
  // Δt²F''/6 and what the jump's samples leave behind: at most 5e-6.
  for (const auto& [time, force] : expected) CHECK(sample(tca, time) == about(force).epsilon(5e-6));
  CHECK(tca.separated);
  CHECK(tca.contact_end_s == about(947.851935e-6).epsilon(2e-6));
  CHECK(impulse_Ns(tca) == about(1.287913769).epsilon(5e-6));
  // The peak is a left limit at 512.696 µs; two samples before the jump the force is known in closed form.
  double peak = 0;
  const Segment cone = bars::cone().profile.front();
  const Segment rod = bars::long_rod().profile.front();
  for (std::size_t k = 0; k + 2 <= 512; ++k) {
    const double exact = cone_on_bar_force_N(cone, rod, 1.16, tca.grid.time_s(k));
    CHECK(tca.force_N[k] == about(exact).epsilon(3e-6));
    peak = std::max(peak, tca.force_N[k]);
  }
  CHECK(cone_on_bar_force_N(cone, rod, 1.16, 512.6960e-6) == about(2550.131311).epsilon(1e-7));
}

TEST_CASE("contact_equation: order 2 in the step, before and after a jump between samples") {
  // 545 and 782 µs lie behind the jump at 512.696 µs, which no step here meets.
  for (const auto& [time, exact] : {std::pair{355e-6, 2216.869017}, {545e-6, 1047.522209}, {782e-6, 672.485290}}) {
    CAPTURE(time);
    std::vector<double> error;
    for (double step : {10e-6, 5e-6, 2.5e-6, 1.25e-6}) {
      const ImpactHistory tca =
          by_waves(bars::cone(), bars::long_rod(), 1.16, {step, static_cast<std::size_t>(900e-6 / step) + 1});
      const double x = time / step;
      const auto k = static_cast<std::size_t>(x + 1e-9);
      const double f = x - static_cast<double>(k);
      error.push_back(std::abs((1 - f) * tca.force_N[k] + f * tca.force_N[k + 1] - exact));
    }
    // The jump's position within its step makes the error behind it irregular: the slope over three halvings.
    CHECK(std::log2(error.front() / error.back()) / 3 > 1.7);
    CHECK(error.back() < 2e-5 * exact);
  }
}

TEST_CASE("contact_equation: CCA and CCB are the exact staircases, five samples from their jumps to 1e-7") {
  for (Face face : {Face::a, Face::b}) {
    const Bar projectile = bars::composite(face);
    const double speed = face == Face::a ? 0.92 : 1.01;
    const double z = face_impedance_kg_per_s(bars::long_rod().profile, Face::a);
    const Profile seen = face == Face::a ? projectile.profile : reversed(projectile.profile);
    const auto jumps = two_delays::jumps(seen, z, speed, 1.1e-3);
    if (face == Face::a) {
      CHECK(jumps[0].second == about(910.024091056).epsilon(1e-11));
      CHECK(jumps[1].first == about(160.217486e-6).epsilon(1e-8));
      CHECK(jumps[1].second == about(957.576).epsilon(1e-6));
      CHECK(jumps[2].second == about(-393.342).epsilon(1e-5));
    }
    const ImpactHistory history = by_waves(projectile, bars::long_rod(), speed, grid_over(900e-6, 1e-6));
    double difference = 0, norm = 0, largest_far = 0, peak = 0, exact_peak = 0;
    for (std::size_t k = 1; history.grid.time_s(k) < 0.9 * history.contact_end_s; ++k) {
      const double t = history.grid.time_s(k);
      double nearest = HUGE_VAL;
      for (std::size_t j = 1; j < jumps.size(); ++j) nearest = std::min(nearest, std::abs(t - jumps[j].first) / 1e-6);
      if (nearest <= 2) continue;
      const double exact = two_delays::force_at(jumps, t);
      difference += std::pow(history.force_N[k] - exact, 2);
      norm += exact * exact;
      if (nearest > 5) largest_far = std::max(largest_far, std::abs(history.force_N[k] - exact));
      peak = std::max(peak, history.force_N[k]);
      exact_peak = std::max(exact_peak, exact);
    }
    CHECK(std::sqrt(difference / norm) < 1e-3);
    CHECK(largest_far <
          1e-7 * jumps[0].second);  // what a jump spoils spreads by a sample with each echo, and dies away
    CHECK(peak == about(exact_peak).epsilon(1e-9));
  }
  CHECK(impulse_Ns(by_waves(bars::composite(), bars::long_rod(), 0.92, grid_over(1e-3, 1e-6))) ==
        about(0.825925167).epsilon(1e-4));
  CHECK(impulse_Ns(by_waves(bars::composite(), bars::long_rod(), 0.92, grid_over(1e-3, 1e-7))) ==
        about(0.825925167).epsilon(1e-5));
}

TEST_CASE("contact_equation: St Venant's rods") {
  const Bar long_rod = bars::long_rod();
  const double z = face_impedance_kg_per_s(long_rod.profile, Face::a);
  const ImpactHistory on_long = by_waves(bars::steel_rod(0.5), long_rod, 1, grid_over(400e-6, 0.05e-6));
  CHECK(sample(on_long, 100e-6) == about(1572.1113183).epsilon(1e-10));
  CHECK(on_long.force_N[0] == about(z / 2).epsilon(1e-12));
  CHECK(on_long.contact_end_s == about(194.3373106e-6).epsilon(1e-3));
  for (double shorter : {0.2, 0.3, 0.4}) {
    CAPTURE(shorter);
    const Bar short_rod = bars::steel_rod(shorter);
    const ImpactHistory history = by_waves(short_rod, bars::steel_rod(0.4), 1, grid_over(400e-6, 0.02e-6));
    const double round_trip = 2 * travel_time_s(short_rod.profile);
    CHECK(sample(history, 0.5 * round_trip) == about(z / 2).epsilon(1e-9));
    CHECK(history.contact_end_s == about(round_trip).epsilon(1e-3));
    // The short rod stops; restitution, the ratio of relative speeds after and before, is L1/L2.
    const double impulse = impulse_Ns(history);
    const double rebound = 1 - impulse / mass_kg(short_rod.profile);
    const double restitution = impulse / mass_kg(bars::steel_rod(0.4).profile) - rebound;
    CHECK(std::abs(rebound) < 1e-3);
    CHECK(restitution == about(shorter / 0.4).epsilon(1e-3));
  }
}

TEST_CASE("contact_equation: a release that is a jump keeps its impulse, on a sample and between samples") {
  const Bar bar = bars::steel_rod(0.4);
  const double round_trip = 2 * travel_time_s(bar.profile);
  const double exact = mass_kg(bar.profile);  // equal rods exchange their speeds
  for (double steps : {8.0, 64.0, 1000.0}) {
    const ImpactHistory history = by_waves(bar, bar, 1, grid_over(1.5 * round_trip, round_trip / steps));
    CHECK(impulse_Ns(history) == about(exact).epsilon(1e-11));
  }
  for (double steps : {80.3, 800.7}) {
    const ImpactHistory history = by_waves(bar, bar, 1, grid_over(1.5 * round_trip, round_trip / steps));
    CHECK(impulse_Ns(history) == about(exact).epsilon(1 / steps));
  }
}

TEST_CASE("contact_equation: a rigid mass on a long rod decays as exp(-Zt/m)") {
  const Bar rod = bars::steel_rod(1, FarEnd::infinite);
  const double z = face_impedance_kg_per_s(rod.profile, Face::a);
  const UniformGrid grid = grid_over(500e-6, 1e-6);
  const ImpactHistory history =
      solve_contact(mass_response(0.5, grid), wave_response(rod, grid), {2}, ContactMethod::product);
  // (Δt Z/m)²/6 = 7e-6; the last sample is extrapolated.
  for (std::size_t k = 0; k < grid.size; ++k)
    CHECK(history.force_N[k] ==
          about(2 * z * std::exp(-z * grid.time_s(k) / 0.5)).epsilon(k + 1 < grid.size ? 1e-5 : 3e-5));
  CHECK_FALSE(history.separated);
  CHECK(history.contact_end_s == grid.duration_s());
}

TEST_CASE("contact_equation: the thesis' method, exact modes up to the Nyquist frequency and the trapezoidal rule") {
  struct Case {
    Bar projectile;
    double speed, thesis_step;
  };
  const Case cases[] = {{bars::composite(Face::a), 0.92, 10e-6}, {bars::composite(Face::b), 1.01, 7.5e-6}};
  for (const Case& c : cases) {
    const Profile seen = c.projectile.faces[0] == Face::a ? c.projectile.profile : reversed(c.projectile.profile);
    const auto jumps =
        two_delays::jumps(seen, face_impedance_kg_per_s(bars::long_rod().profile, Face::a), c.speed, 1e-3);
    const double end = c.speed == 0.92 ? 789.230551e-6 : 666.58e-6;
    const struct { double step, l2; } levels[] = {{c.thesis_step, 0.05}, {end / 1000, 0.015}, {end / 10000, 0.005}};
    for (const auto& level : levels) {
      CAPTURE(level.step);
      const UniformGrid grid{level.step, static_cast<std::size_t>(1e-3 / level.step) + 1};
      const ImpactHistory history = solve_contact(modal(c.projectile, grid), modal(bars::long_rod(), grid), {c.speed},
                                                  ContactMethod::trapezoidal);
      // Jumps included: the piecewise linear force against the staircase.
      double difference = 0, norm = 0;
      for (double t = 5e-9; t < end; t += 10e-9) {
        const double x = t / level.step;
        const auto k = static_cast<std::size_t>(x);
        const double force =
            history.force_N[k] + (x - static_cast<double>(k)) * (history.force_N[k + 1] - history.force_N[k]);
        const double exact = two_delays::force_at(jumps, t);
        difference += std::pow(force - exact, 2);
        norm += exact * exact;
      }
      CHECK(std::sqrt(difference / norm) < level.l2);
    }
  }
  const UniformGrid grid = grid_over(1e-3, 0.9478e-6);
  const ImpactHistory tca =
      solve_contact(modal(bars::cone(), grid), modal(bars::long_rod(), grid), {1.16}, ContactMethod::trapezoidal);
  CHECK(impulse_Ns(tca) == about(1.287913769).epsilon(3e-4));
}

TEST_CASE("contact_equation: the solvers agree with forward substitution on smooth kernels") {
  const UniformGrid grid = grid_over(2e-3, 1e-6);
  const Bar horn{{parse_segment("3m,20mm,60mm,aluminium")}, {Face::a}, FarEnd::infinite};
  const struct {
    Response a, b;
  } pairs[] = {{mass_response(3, grid), wave_response(horn, grid)},
               {smooth_response(grid, 2e-9), mass_response(3, grid)}};
  for (const auto& [a, b] : pairs) {
    // The direct twins, straight from the definition: means of steps where the force can jump, else samples from F_0 =
    // 0.
    const bool jumps = a.pair(0, 0).step_displacement_m_per_N[0] == 0;
    std::vector<double> w(grid.size - 1);
    for (const Response* body : {&a, &b}) {
      std::vector<double> u = body->pair(0, 0).step_displacement_m_per_N;
      u[0] = 0;
      w[0] += u[1] / grid.step_s;
      for (std::size_t k = 1; k < w.size(); ++k) w[k] += (u[k + 1] - 2 * u[k] + u[k - 1]) / grid.step_s;
    }
    const std::vector<double> x = direct::toeplitz_solution(w, std::vector<double>(w.size(), 1.0));
    std::vector<double> twin(grid.size);
    for (std::size_t n = 1; n < grid.size; ++n)
      twin[n] = jumps && n < x.size() ? 0.5 * (x[n - 1] + x[n]) : jumps ? 1.5 * x[n - 1] - 0.5 * x[n - 2] : x[n - 1];
    twin[0] = jumps ? 1 / b.pair(0, 0).step_velocity_m_per_Ns[0] : 0;
    const std::size_t end = contact_end_index(twin);
    std::fill(twin.begin() + static_cast<std::ptrdiff_t>(end), twin.end(), 0.0);
    const double peak = *std::max_element(twin.begin(), twin.end());
    CHECK(end > 50);
    CHECK(direct::largest_difference(solve_contact(a, b, {1}, ContactMethod::product).force_N, twin) < 1e-12 * peak);
    CHECK(direct::largest_difference(solve_contact(a, b, {1}, ContactMethod::series).force_N, twin) < 1e-12 * peak);
    CHECK(direct::largest_difference(solve_contact(a, b, {1}, ContactMethod::fourier).force_N, twin) < 1e-9 * peak);
  }
}

TEST_CASE("contact_equation: the trapezoidal rule equals its direct twin") {
  const double step = 2e-6;
  const UniformGrid grid{step, static_cast<std::size_t>(std::lround(1e-3 / step)) + 1};
  const Response a = modal(bars::steel_rod(0.5), grid);
  const Response b = modal(bars::long_rod(), grid);
  const ImpactHistory history = solve_contact(a, b, {1}, ContactMethod::trapezoidal);
  std::vector<double> w(grid.size - 1), rhs(grid.size - 1);
  const double f0 = 1 / (a.pair(0, 0).step_velocity_m_per_Ns[0] + b.pair(0, 0).step_velocity_m_per_Ns[0]);
  for (std::size_t k = 0; k < grid.size; ++k) {
    const double g = a.pair(0, 0).impulse_response_per_kg[k] + b.pair(0, 0).impulse_response_per_kg[k];
    if (k < w.size()) w[k] = step * g * (k == 0 ? 0.5 : 1.0);
    if (k > 0) rhs[k - 1] = 1 - 0.5 * step * g * f0;
  }
  std::vector<double> twin = direct::toeplitz_solution(w, rhs);
  twin.insert(twin.begin(), f0);
  std::fill(twin.begin() + static_cast<std::ptrdiff_t>(contact_end_index(twin)), twin.end(), 0.0);
  CHECK(direct::largest_difference(history.force_N, twin) < 1e-12 * f0);
}

TEST_CASE("contact_equation: faces keep together, energy error falls with the step, momentum is the impulse") {
  double before = 0;
  for (double step : {2e-6, 1e-6, 0.5e-6}) {
    const ImpactHistory tca = by_waves(bars::cone(), bars::long_rod(), 1.16, grid_over(900e-6, step));
    double apart = 0;
    for (std::size_t k = 1; k + 1 < tca.grid.size; ++k)
      apart = std::max(apart, std::abs(tca.velocity_1_m_per_s[k] - tca.velocity_2_m_per_s[k]));
    CHECK(apart < 1e-11 * 1.16);
    CHECK(tca.energy_error < 1e-3);
    if (before > 0) CHECK(tca.energy_error < 0.75 * before);
    before = tca.energy_error;
  }
}

TEST_CASE("contact_equation: linear in the speed, indifferent to which body is called 1") {
  const UniformGrid grid = grid_over(1e-3, 2e-6);
  const Response cone = wave_response(bars::cone(), grid);
  const Response rod = wave_response(bars::long_rod(), grid);
  const ImpactHistory once = solve_contact(cone, rod, {1}, ContactMethod::product);
  const ImpactHistory twice = solve_contact(rod, cone, {2}, ContactMethod::product);
  double largest = 0;
  for (std::size_t k = 0; k < grid.size; ++k) {
    largest = std::max(largest, std::abs(twice.force_N[k] - 2 * once.force_N[k]));
    // Seen from the other body: v₂ of the one is 2·(V - ...) of the other.
    CHECK(std::abs(twice.velocity_1_m_per_s[k] - (2 - 2 * once.velocity_2_m_per_s[k])) < 1e-11);
  }
  CHECK(largest < 1e-9);
}

TEST_CASE("contact_equation: refuses rigid masses on each other") {
  const UniformGrid grid = grid_over(1e-4, 1e-6);
  CHECK_THROWS_WITH_AS((void)solve_contact(mass_response(1, grid), mass_response(2, grid), {1}, ContactMethod::product),
                       doctest::Contains("both bodies are rigid"), std::invalid_argument);
}

TEST_CASE("contact_equation: refuses what it can't resolve and names what works") {
  const UniformGrid grid = grid_over(1e-3, 10e-6);
  const Response rod = wave_response(bars::long_rod(), grid);
  const Response cone = wave_response(bars::cone(), grid);
  const auto solve = [&](const Response& a, const Response& b, double v, ContactMethod m) {
    static_cast<void>(solve_contact(a, b, {v}, m));
  };
  CHECK_THROWS_WITH_AS(solve(cone, rod, 1, ContactMethod::trapezoidal), doctest::Contains("use --method product"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(solve(cone, rod, 0, ContactMethod::product), doctest::Contains("speed 0 m/s is not positive"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(solve(cone, wave_response(bars::long_rod(), grid_over(1e-3, 5e-6)), 1, ContactMethod::product),
                       doctest::Contains("different grids"), std::invalid_argument);
  // Three times the modes that the step resolves: the step that works is named.
  const Response fine = modal_response(exact_bar_modes(bars::long_rod(), {.highest_frequency_Hz = 150e3}), grid);
  CHECK_THROWS_WITH_AS(solve(modal(bars::cone(), grid), fine, 1, ContactMethod::trapezoidal),
                       doctest::Contains("or a step of 3.3"), std::invalid_argument);
  Response broken = rod;
  broken.pair(0, 0).step_displacement_m_per_N[5] = NAN;
  CHECK_THROWS_WITH_AS(solve(cone, broken, 1, ContactMethod::product), doctest::Contains("holds nan at sample 5"),
                       std::invalid_argument);
  for (double& u : broken.pair(0, 0).step_displacement_m_per_N) u = -1;
  CHECK_THROWS_WITH_AS(solve(cone, broken, 1, ContactMethod::product), doctest::Contains("not a passive response"),
                       std::invalid_argument);
}
