// Impacts whose course is known in closed form: several points, preload, other motion, gravity, energy.
#include "impulse/contact/contacts_problem.hpp"
#include "impulse/response/mass_response.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/wave_response.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

using namespace impulse;

namespace {

ContactsProblem problem_of(std::vector<double> speeds, const std::vector<ContactLaw>& laws) {
  ContactsProblem problem;
  problem.speed_m_per_s = std::move(speeds);
  problem.laws = laws;
  problem.gaps_m.assign(laws.size(), 0.0);
  problem.recontact = Recontact::yes;
  return problem;
}

ContactsProblem rigid_problem(std::vector<double> speeds, std::size_t contacts) {
  return problem_of(std::move(speeds), std::vector<ContactLaw>(contacts, ContactLaw::rigid()));
}

/// Responses side by side, as the contacts of one body that do not feel each other.
Response side_by_side(const Response& a, const Response& b) {
  Response both = zero_response(a.grid, 2);
  both.pair(0, 0) = a.pairs[0];
  both.pair(1, 1) = b.pairs[0];
  return both;
}

/// A rigid mass seen at two points.
Response mass_at_two_points(double mass_kg, const UniformGrid& grid) {
  const Response one = mass_response(mass_kg, grid);
  return {grid, 2, std::vector<PairResponse>(4, one.pairs[0])};
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (double value : values) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace

TEST_CASE("contact_scenes: rigid mass on a fixed-free rod: largest stress at the fixed end, every mass ratio") {
  // Mass, rod and wall in a row: the second contact bears the stress of the fixed end, over EV/c, the largest of which
  // may arrive after the mass has left.
  const double table[][3] = {{4, 2.0007, 2.2501},   {2, 2.0366, 2.5046},    {1, 2.2707, 3.0677},
                             {0.5, 2.7358, 4.7086}, {0.25, 3.2131, 5.8996}, {1.0 / 6, 3.5045, 7.4076},
                             {0.1, 4.3231, 9.5411}};
  for (const auto& [ratio, peak, end] : table) {
    CAPTURE(ratio);
    const double step = 0.025e-6;
    // The sample after a jump is a step later: the force has decayed by ratio/cells.
    const auto cells = static_cast<std::size_t>(std::lround(4000 * std::max(0.5, ratio)));
    const UniformGrid grid{
        step, static_cast<std::size_t>(std::ceil(1.05 * std::max(end, 3.0) * static_cast<double>(cells))) + 1};
    const Bar bar = bars::rod_of_cells(cells, step, 0.02, {Face::a, Face::b});
    const std::vector<Response> bodies{mass_response(mass_kg(bar.profile) / ratio, grid), wave_response(bar, grid),
                                       zero_response(grid, 1)};
    const ContactsSolution solution = solve_contacts(bodies, rigid_problem({1, 0, 0}, 2));
    CHECK(largest(solution.traces[1].force_N) / bars::impedance(bar) == about(peak).epsilon(1e-3));
    const ContactInterval struck = contact_intervals(solution.traces[0], grid).front();
    CHECK(struck.end_s / (static_cast<double>(cells) * step) == about(end).epsilon(1e-3));
  }
}

TEST_CASE("contact_scenes: energy balances to 1e-6 of the initial energy for every law that yields, at 1 µs") {
  const UniformGrid grid = grid_over(1.5e-3, 1e-6);
  const double mass = 0.0333, speed = 2, energy = 0.5 * mass * speed * speed;
  const Response ball = mass_response(mass, grid), bar = wave_response(bars::steel_rod(0.3), grid);
  for (const ContactLaw& law :
       {ContactLaw::linear(1e8), ContactLaw::hertz(1.5e10), ContactLaw::tan_sun(1.413e9, 0.094, 1.667e-5),
        ContactLaw::table({{0, 5e-5, 1e-4, 2e-4}, {0, 2000, 6000, 2e4}, {}}),
        ContactLaw::table({{0, 5e-5, 1e-4, 2e-4}, {0, 2000, 6000, 2e4}, {0, 100, 2500, 2e4}})}) {
    const ContactsSolution solution = solve_contacts({ball, bar}, problem_of({speed, 0}, {law}));
    const ContactTrace& f = solution.traces[0];
    double worst = 0;
    for (std::size_t n = 0; n < grid.size; ++n)
      worst = std::max(worst, std::abs(f.work_1_J[n] + f.work_2_J[n] + f.stored_J[n] + f.dissipated_J[n]));
    CHECK(largest(f.force_N) > 100);
    CHECK(worst < 1e-9 * energy);
    CHECK(solution.energy_error < 1e-9);
  }
}

TEST_CASE(
    "contact_scenes: faces with a residual flexibility stay an indentation apart; its energy is the bodies' own") {
  ModalModel body{Eigen::VectorXd::Zero(3), Eigen::VectorXd::Zero(3), Eigen::MatrixXd::Zero(3, 1),
                  Eigen::MatrixXd::Constant(1, 1, 2e-9), Eigen::MatrixXd::Zero(1, 1)};
  body.angular_frequency << 0, 6e4, 1.7e5;
  body.participation << 1, 1.4, 1.4;
  std::vector<double> worst_balance;
  for (const ContactLaw& law : {ContactLaw::rigid(), ContactLaw::hertz(1.5e10)})
    for (double step : {2e-6, 1e-6, 0.5e-6}) {
      const UniformGrid grid = grid_over(1e-3, step);
      const Response ball = mass_response(0.0333, grid);
      const ContactTrace f =
          solve_contacts(std::vector<ContactBody>{ball, body}, grid, problem_of({2, 0}, {law})).traces[0];
      double balance = 0;
      for (std::size_t n = 0; n < grid.size; ++n) {
        CHECK(std::abs(f.displacement_1_m[n] - f.displacement_2_m[n] - f.indentation_m[n]) < 1e-13);
        balance = std::max(balance, std::abs(f.work_1_J[n] + f.work_2_J[n] + f.stored_J[n] + f.dissipated_J[n]));
      }
      worst_balance.push_back(balance / (0.5 * 0.0333 * 4));
    }
  // Order 2: of the spring 1/R that a rigid contact then is, by the steps in which it opens; of a law in every step.
  CHECK(worst_balance[0] < 1e-2);
  CHECK(worst_balance[2] < worst_balance[0] / 8);
  CHECK(worst_balance[3] < 1e-3);
  CHECK(std::log2(worst_balance[3] / worst_balance[5]) / 2 == about(2).epsilon(0.1));
}

TEST_CASE(
    "contact_scenes: a residual flexibility across two points acts at once: V sin(ωt)/((r + s + 1/k)ω), order 2") {
  // A rigid body that can turn, on a base of flexibility [r s; s r] without inertia. Both points bear the same force,
  // which takes back 2·1.4² F: ω² = 2·1.4²/(r + s + 1/k).
  const double r = 2e-8, s = 1e-8, speed = 1.5;
  ModalModel body{Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(2), Eigen::MatrixXd(2, 2),
                  Eigen::MatrixXd::Zero(2, 2), Eigen::MatrixXd::Zero(2, 2)};
  body.participation << 1.4, 1.4, 2.0, -2.0;
  ModalModel base{Eigen::VectorXd::Constant(1, 1e3), Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Zero(1, 2),
                  Eigen::MatrixXd(2, 2), Eigen::MatrixXd::Zero(2, 2)};
  base.residual_flexibility << r, s, s, r;
  for (const bool yields : {false, true}) {
    const double k = 1e8, flexibility = r + s + (yields ? 1 / k : 0), omega = std::sqrt(2 * 1.4 * 1.4 / flexibility);
    const ContactLaw law = yields ? ContactLaw::linear(k) : ContactLaw::rigid();
    for (const HistoryMethod method : {HistoryMethod::modes, HistoryMethod::convolution}) {
      std::vector<double> error;
      for (const double step : {8e-6, 4e-6, 2e-6, 1e-6}) {
        const UniformGrid grid = grid_over(200e-6, step);
        ContactsProblem problem = problem_of({speed, 0}, {law, law});
        problem.history = method;
        const ContactsSolution solution = solve_contacts(std::vector<ContactBody>{body, base}, grid, problem);
        error.push_back(0);
        for (const ContactTrace& trace : solution.traces)
          for (std::size_t n = 0; n < grid.size; ++n) {
            const double exact = speed / (flexibility * omega) * std::sin(omega * grid.time_s(n));
            error.back() = std::max(error.back(), std::abs(trace.force_N[n] - exact) * flexibility * omega / speed);
            // Face to face as the law says, and what the bodies hold is theirs.
            CHECK(std::abs(trace.displacement_1_m[n] - trace.displacement_2_m[n] - trace.indentation_m[n]) < 1e-13);
          }
        CHECK(solution.energy_error < 1e-12);
      }
      CHECK(error.back() < 2e-5);
      CHECK(std::log2(error.front() / error.back()) / 3 == about(2).epsilon(0.05));
    }
  }
  base.residual_flexibility << r, 1.1 * r, 1.1 * r, r;
  CHECK_THROWS_WITH_AS(static_cast<void>(solve_contacts(std::vector<ContactBody>{body, base}, grid_over(20e-6, 1e-6),
                                                        rigid_problem({1, 0}, 2))),
                       doctest::Contains("contacts 1 and 2: 1 N at one moves the other at once by 2.2e-08 m, but at "
                                         "most √(R11 R22) = 2e-08 m is possible"),
                       std::invalid_argument);
}

TEST_CASE(
    "contact_scenes: a rigid contact that may not close again ends with three steps without force, not with two") {
  // Two endless rods pressed together by a free velocity that turns round for some samples: steps with the mean of V
  // and -V bear nothing, as those with -V.
  const UniformGrid grid = grid_over(60e-6, 1e-6);
  const Response endless = wave_response(bars::steel_rod(1, FarEnd::infinite), grid);
  const double speed = 2, force = speed * bars::impedance(bars::steel_rod(1, FarEnd::infinite)) / 2;
  for (const std::size_t turned : {1u, 2u})
    for (const Recontact recontact : {Recontact::no, Recontact::yes}) {
      ContactsProblem problem = rigid_problem({0, 0}, 1);
      problem.recontact = recontact;
      problem.free_velocity_first_m_per_s.assign(grid.size, speed);
      for (std::size_t n = 20; n < 20 + turned; ++n) problem.free_velocity_first_m_per_s[n] = -speed;
      const ContactTrace trace = solve_contacts({endless, endless}, problem).traces[0];
      const bool again = turned == 1 || recontact == Recontact::yes;
      CHECK(trace.force_N[10] == about(force).epsilon(1e-9));
      CHECK(trace.force_N[50] == about(again ? force : 0).epsilon(1e-9));
      CHECK(trace.in_contact[50] == again);
    }
}

TEST_CASE("contact_scenes: points that a rigid mass ties together are one contact: two rods are one of Z1 + Z2") {
  const UniformGrid grid = grid_over(400e-6, 0.5e-6);
  const Bar thin = bars::steel_rod(1, FarEnd::infinite, 0.01), thick = bars::steel_rod(1, FarEnd::infinite, 0.02);
  const double z = bars::impedance(thin) + bars::impedance(thick), mass = 0.5, speed = 3;
  const Response rods = side_by_side(wave_response(thin, grid), wave_response(thick, grid));
  const ContactsSolution tied = solve_contacts({mass_at_two_points(mass, grid), rods}, rigid_problem({speed, 0}, 2));
  // The condensed response is U = t/(Z1 + Z2).
  const Bar together = bars::steel_rod(1, FarEnd::infinite, std::sqrt(0.01 * 0.01 + 0.02 * 0.02));
  const ContactsSolution condensed =
      solve_contacts({mass_response(mass, grid), wave_response(together, grid)}, rigid_problem({speed, 0}, 1));
  double worst = 0, worst_exact = 0;
  for (std::size_t n = 0; n < grid.size; ++n) {
    const double sum = tied.traces[0].force_N[n] + tied.traces[1].force_N[n];
    worst = std::max(worst, std::abs(sum - condensed.traces[0].force_N[n]));
    if (n > 0 && n + 1 < grid.size)
      worst_exact = std::max(worst_exact, std::abs(sum - speed * z * std::exp(-z * grid.time_s(n) / mass)));
    CHECK(tied.traces[0].force_N[n] * bars::impedance(thick) ==
          about(tied.traces[1].force_N[n] * bars::impedance(thin)).epsilon(1e-9));
  }
  CHECK(worst < 1e-9 * speed * z);
  CHECK(worst_exact < 1e-4 * speed * z);
}

TEST_CASE("contact_scenes: one point parts alone, and the other bears on") {
  // The short rod's echo releases it after 2L/c; from then on the mass is slowed by the long one only.
  const double step = 0.25e-6;
  const UniformGrid grid = grid_over(300e-6, step);
  const Bar brief = bars::rod_of_cells(200, step, 0.02, {Face::a}),
            lasting = bars::steel_rod(1, FarEnd::infinite, 0.015);
  const double z1 = bars::impedance(brief), z2 = bars::impedance(lasting), mass = 0.5, speed = 3, release = 400 * step;
  const Response rods = side_by_side(wave_response(brief, grid), wave_response(lasting, grid));
  const ContactsSolution solution =
      solve_contacts({mass_at_two_points(mass, grid), rods}, rigid_problem({speed, 0}, 2));
  const std::vector<ContactInterval> first = contact_intervals(solution.traces[0], grid);
  const std::vector<ContactInterval> second = contact_intervals(solution.traces[1], grid);
  REQUIRE(first.size() == 1);
  CHECK(std::abs(first[0].end_s - release) <= 1.001 * step);
  REQUIRE(second.size() == 1);
  CHECK(second[0].open_ended);
  for (std::size_t n = 1; n + 1 < grid.size; ++n) {
    const double t = grid.time_s(n);
    if (std::abs(t - release) < 1.5 * step) continue;  // the jump
    const bool both = t < release;
    const double v = speed * (both ? std::exp(-(z1 + z2) * t / mass)
                                   : std::exp(-(z1 + z2) * release / mass - z2 * (t - release) / mass));
    CHECK(solution.traces[0].force_N[n] == doctest::Approx(both ? z1 * v : 0).epsilon(1e-4).scale(1e-9));
    CHECK(solution.traces[1].force_N[n] == about(z2 * v).epsilon(1e-4));
  }
}

TEST_CASE("contact_scenes: a preloaded joint answers a passing wave, of either body, and opens when it pulls enough") {
  const UniformGrid grid = grid_over(400e-6, 0.25e-6);
  const Bar left = bars::steel_rod(1, FarEnd::infinite, 0.01), right = bars::steel_rod(1, FarEnd::infinite, 0.02);
  const double z = 1 / (1 / bars::impedance(left) + 1 / bars::impedance(right));
  const auto approach = [](double t) { return 0.3 * std::sin(2e4 * t); };  // of the faces were there no contact
  const std::vector<Response> bodies{wave_response(left, grid), wave_response(right, grid)};
  for (double preload : {1.2 * 0.3 * z, 0.4 * 0.3 * z}) {
    CAPTURE(preload);
    ContactsProblem of_first = rigid_problem({0, 0}, 1), of_last = of_first;
    of_first.preload_N = of_last.preload_N = preload;
    for (std::size_t n = 0; n < grid.size; ++n) {
      of_first.free_velocity_first_m_per_s.push_back(approach(grid.time_s(n)));
      of_last.free_velocity_last_m_per_s.push_back(-approach(grid.time_s(n)));
    }
    const ContactTrace f = solve_contacts(bodies, of_first).traces[0];
    const ContactTrace g = solve_contacts(bodies, of_last).traces[0];
    bool opened = false;
    for (std::size_t n = 1; n + 1 < grid.size; ++n) {
      CHECK(f.force_N[n] == doctest::Approx(g.force_N[n]).epsilon(1e-12).scale(1e-9 * preload));
      // Until it has opened: F = P + Z v, Z of both in series; means of two steps lag by (ωΔt)²/4 of the wave at most.
      opened = opened || preload + z * approach(grid.time_s(n + 1)) < 0;
      if (!opened) CHECK(std::abs(f.force_N[n] - preload - z * approach(grid.time_s(n))) < 1e-4 * preload);
    }
    CHECK(opened == (preload < 0.3 * z));
    CHECK((contact_intervals(f, grid).size() > 1) == opened);
  }
}

TEST_CASE("contact_scenes: a steady free velocity is a speed") {
  const UniformGrid grid = grid_over(300e-6, 0.5e-6);
  const std::vector<Response> bodies{wave_response(bars::steel_rod(0.3), grid), wave_response(bars::long_rod(), grid)};
  ContactsProblem moving = problem_of({1.5, -0.5}, {ContactLaw::hertz(1e10)}),
                  carried = problem_of({0, 0}, {ContactLaw::hertz(1e10)});
  carried.free_velocity_first_m_per_s.assign(grid.size, 1.5);
  carried.free_velocity_last_m_per_s.assign(grid.size, -0.5);
  const ContactTrace a = solve_contacts(bodies, moving).traces[0], b = solve_contacts(bodies, carried).traces[0];
  CHECK(a.force_N == b.force_N);
  CHECK(a.velocity_2_m_per_s == b.velocity_2_m_per_s);
}

TEST_CASE("contact_scenes: a rod that bounces under gravity, closing within a step: order 1") {
  // A free rod falls freely, so that its face would move with g t. From height h it meets the wall with V = √(2gh); F =
  // Z(V + g t) for 2L/c, the impulse 2mV + 2mg L/c.
  const double g = 2000, cell = 1e-6 / 27;  // heavy gravity: it has to act within a test
  const std::size_t cells = 27 * 40;        // 40 µs a crossing at the coarsest step
  const Bar bar = bars::rod_of_cells(cells, cell, 0.02, {Face::a});
  const double m = mass_kg(bar.profile), crossing = static_cast<double>(cells) * cell;
  // Contact at half a step of every level, because the levels differ by odd factors.
  const double arrival = 100.5e-6, speed = g * arrival, height = 0.5 * g * arrival * arrival;
  const double exact = 2 * m * speed + 2 * m * g * crossing;
  std::vector<double> error, after_two;
  for (double refinement : {1.0, 3.0, 9.0, 27.0}) {
    const double step = 1e-6 / refinement;
    const UniformGrid grid = grid_over(900e-6, step);
    ContactsProblem problem = rigid_problem({0, 0}, 1);
    problem.gaps_m = {height};
    for (std::size_t n = 0; n < grid.size; ++n) problem.free_velocity_first_m_per_s.push_back(g * grid.time_s(n));
    const ContactsSolution solution = solve_contacts({wave_response(bar, grid), zero_response(grid, 1)}, problem);
    const std::vector<ContactInterval> bounces = contact_intervals(solution.traces[0], grid);
    REQUIRE(bounces.size() >= 3);
    CHECK(std::abs(bounces[0].start_s - arrival) <= step);
    error.push_back(std::abs(bounces[0].impulse_Ns / exact - 1));
    after_two.push_back(bounces[0].impulse_Ns + bounces[1].impulse_Ns);
  }
  for (std::size_t level : {0u, 1u, 2u}) {
    CHECK(std::log(error[level] / error[level + 1]) / std::log(3) == about(1).epsilon(0.1));
    // The second bounce starts anywhere within a step; each closing may misplace what F does in half of one.
    const double step = 1e-6 / std::pow(3, level);
    CHECK(std::abs(after_two[level] - after_two[level + 1]) < 2 * bars::impedance(bar) * speed * step / 2);
  }
  CHECK(error[3] < 1e-4);
}

TEST_CASE("contact_scenes: echoes between samples do not cut a rigid contact up") {
  // Hammer, anvil and drill rod: the anvil's echoes come every 58.3 µs and drop the force in stairs that stay positive.
  std::vector<double> impulse;
  for (double step : {1e-6, 0.5e-6}) {
    CAPTURE(step);
    const UniformGrid grid = grid_over(0.5e-3, step);
    const Bar anvil{{parse_segment("150mm,60mm,steel")}, {Face::a, Face::b}, FarEnd::free};
    const std::vector<Response> bodies{mass_response(2, grid), wave_response(anvil, grid),
                                       wave_response(bars::steel_rod(3, FarEnd::free, 0.032), grid)};
    const ContactTrace trace = solve_contacts(bodies, rigid_problem({8, 0, 0}, 2)).traces[1];
    const std::vector<ContactInterval> periods = contact_intervals(trace, grid);
    REQUIRE(periods.size() == 1);
    CHECK(periods[0].start_s == about(29e-6).epsilon(0.02));
    CHECK(periods[0].open_ended);
    impulse.push_back(trace.running_impulse_Ns.back());
    // A front does open the faces for a sample: the force is zero there and the contact is not over.
    bool zero_within = false;
    for (std::size_t n = 60; n + 1 < grid.size; ++n)
      zero_within = zero_within || (trace.force_N[n] < 1e-3 * periods[0].peak_force_N && trace.in_contact[n]);
    CHECK(zero_within);
  }
  CHECK(impulse[0] == about(impulse[1]).epsilon(1e-3));
}

TEST_CASE("contact_scenes: a mass strikes a second with a third behind it, on springs: two normal modes, order 2") {
  // Equal masses m, equal springs k: δ₁,₂ = V/2 [sin(ω₁t)/ω₁ ± sin(ω₂t)/ω₂], ω₁² = k/m, ω₂² = 3k/m, until a spring lets
  // go, after ω₁t = 2.
  const double m = 0.3, k = 1e6, speed = 2, omega = std::sqrt(k / m), faster = std::sqrt(3.0) * omega;
  std::vector<double> errors;
  for (const std::size_t steps : {50u, 100u, 200u, 400u}) {
    const UniformGrid grid{2 / omega / static_cast<double>(steps), steps + 1};
    const ContactsSolution solution =
        solve_contacts({mass_response(m, grid), mass_response(m, {Face::a, Face::b}, grid), mass_response(m, grid)},
                       problem_of({speed, 0, 0}, {ContactLaw::linear(k), ContactLaw::linear(k)}));
    double worst = 0;
    for (std::size_t n = 0; n < grid.size; ++n) {
      const double t = grid.time_s(n), slow = std::sin(omega * t) / omega, fast = std::sin(faster * t) / faster;
      worst = std::max(worst, std::abs(solution.traces[0].force_N[n] - 0.5 * k * speed * (slow + fast)));
      worst = std::max(worst, std::abs(solution.traces[1].force_N[n] - 0.5 * k * speed * (slow - fast)));
    }
    errors.push_back(worst * omega / (k * speed));
  }
  CHECK(errors.back() > 1e-8);
  CHECK(std::abs(std::log2(errors.front() / errors.back()) / 3 - 2) <= 0.1);
  CHECK(errors.back() < 1e-4);
}
