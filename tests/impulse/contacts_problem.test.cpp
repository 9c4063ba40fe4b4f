#include "impulse/contact/contacts_problem.hpp"

#include "impulse/contact/contact_equation.hpp"
#include "impulse/response/mass_response.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/wave_response.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"
#include "tests/support/characteristics.hpp"

#include <doctest/doctest.h>

using namespace impulse;

namespace {

ContactsProblem rigid_problem(std::vector<double> speeds, std::size_t contacts) {
  ContactsProblem problem;
  problem.speed_m_per_s = std::move(speeds);
  problem.laws.assign(contacts, ContactLaw::rigid());
  problem.gaps_m.assign(contacts, 0.0);
  problem.recontact = Recontact::yes;
  return problem;
}

Response wall(const UniformGrid& grid) { return zero_response(grid, 1); }

double largest_force(const ContactTrace& trace) {
  return *std::max_element(trace.force_N.begin(), trace.force_N.end());
}

}  // namespace

TEST_CASE(
    "contacts_problem: a chain of three rods against exact characteristics, separations and re-contacts included") {
  const double step = 1e-6;
  const UniformGrid grid = grid_over(800e-6, step);
  const Bar a = bars::rod_of_cells(37, step, 0.02, {Face::a}),
            b = bars::rod_of_cells(23, step, 0.012, {Face::a, Face::b}),
            c = bars::rod_of_cells(61, step, 0.03, {Face::a});
  const auto exact =
      characteristics::simulate({{bars::impedance(a), 37, 5}, {bars::impedance(b), 23, 0}, {bars::impedance(c), 61, 0}},
                                {-1, 0, 0, -1}, step, grid.size);
  const ContactsSolution solution = solve_contacts(
      {wave_response(a, grid), wave_response(b, grid), wave_response(c, grid)}, rigid_problem({5, 0, 0}, 2));
  for (std::size_t contact : {0u, 1u}) {
    CAPTURE(contact);
    double impulse = 0, worst = 0, total = 0;
    for (std::size_t k = 0; k + 1 < grid.size; ++k) {
      impulse += step * exact.force[contact + 1][k];
      worst = std::max(worst, std::abs(solution.traces[contact].running_impulse_Ns[k + 1] - impulse));
      total = impulse;
    }
    CHECK(total > 0.1);
    CHECK(worst < 1e-9 * total);
  }
  CHECK(contact_intervals(solution.traces[1], grid).size() >= 1);
  CHECK(solution.energy_error < 1e-9);
}

TEST_CASE("contacts_problem: a rod bounces ten times between two walls and keeps its energy") {
  // Crossing time 40 steps, contact 80 steps, flight 100 steps.
  const double step = 1e-6, speed = 2;
  const UniformGrid grid = grid_over(2500e-6, step);
  const Bar body = bars::rod_of_cells(40, step, 0.02, {Face::a, Face::b});
  const double gap = 100 * step * speed;
  ContactsProblem problem = rigid_problem({0, speed, 0}, 2);
  problem.gaps_m = {gap, gap / 2};
  const ContactsSolution solution = solve_contacts({wall(grid), wave_response(body, grid), wall(grid)}, problem);
  std::vector<ContactInterval> all = contact_intervals(solution.traces[0], grid);
  for (const ContactInterval& interval : contact_intervals(solution.traces[1], grid)) all.push_back(interval);
  std::sort(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.start_s < y.start_s; });
  REQUIRE(all.size() >= 10);
  const double kinetic = 0.5 * mass_kg(body.profile) * speed * speed;
  // The second wall is met first, after 50 steps; then 80 in contact and 150 of flight (both gaps) in turn.
  for (std::size_t k = 0; k < 10; ++k) {
    const double start = (50 + 230 * static_cast<double>(k)) * step;
    CHECK(std::abs(all[k].start_s - start) <= 1.001 * step);
    CHECK(std::abs(all[k].end_s - start - 80 * step) <= 1.001 * step);
    CHECK(all[k].impulse_Ns == about(2 * mass_kg(body.profile) * speed).epsilon(1e-8));
  }
  CHECK(std::abs(solution.traces[0].work_2_J.back() + solution.traces[1].work_1_J.back()) < 1e-8 * kinetic);
  CHECK(solution.energy_error < 1e-8);
}

TEST_CASE("contacts_problem: percussive drilling: a rectangular wave on a spring, efficiency 2(1 - e^-x)²/x") {
  // The wave arrives as the motion that the free rod end would have, twice the wave's velocity for its length τ; the
  // rock is a spring on a wall.
  const double tau = 100e-6, wave_speed = 3;
  const Bar rod_bar = bars::steel_rod(1, FarEnd::infinite, 0.03);
  const double z = bars::impedance(rod_bar);
  const auto efficiency = [&](double x, double step) {
    const UniformGrid grid = grid_over(tau + 5 * step, step);
    ContactsProblem problem = rigid_problem({0, 0}, 1);
    problem.laws = {ContactLaw::linear(x * z / tau)};
    problem.free_velocity_first_m_per_s.assign(grid.size, 2 * wave_speed);
    for (std::size_t k = grid.size - 5; k < grid.size; ++k)
      problem.free_velocity_first_m_per_s[k] = 0;  // the sample τ is among them: half a step early
    const ContactTrace trace = solve_contacts({wave_response(rod_bar, grid), wall(grid)}, problem).traces[0];
    // Rigid unloading: what the spring holds at its deepest is the work done. The wave's energy as sampled.
    return *std::max_element(trace.stored_J.begin(), trace.stored_J.end()) / (z * wave_speed * wave_speed * tau);
  };
  CHECK(efficiency(1.256438, 0.5e-9) == about(0.814529).epsilon(1e-5));
  // The front between samples costs order 1; extrapolated, the formula is met at any stiffness.
  for (double x : {0.5, 2.0}) {
    const double extrapolated = 2 * efficiency(x, 0.05e-6) - efficiency(x, 0.1e-6);
    CHECK(extrapolated == about(2 * std::pow(1 - std::exp(-x), 2) / x).epsilon(1e-5));
  }
  double best = 0, at = 0;
  for (double x = 1.15; x < 1.36; x += 0.01) {
    const double e = 2 * efficiency(x, 0.1e-6) - efficiency(x, 0.2e-6);
    if (e > best) {
      best = e;
      at = x;
    }
  }
  CHECK(best == about(0.814529).epsilon(1e-5));
  CHECK(std::abs(at - 1.256438) < 0.01);
}

TEST_CASE("contacts_problem: rigid mass on a fixed-free rod, every mass ratio") {
  // α = rod mass/M; largest stress at the struck end over EV/c, its time over L/c (a right limit), contact end over
  // L/c.
  const double table[][4] = {{4, 2.0003, 2, 2.2501},   {2, 2.0183, 2, 2.5046},    {1, 2.1353, 2, 3.0677},
                             {0.5, 2.3679, 2, 4.7086}, {0.25, 2.9744, 4, 5.8996}, {1.0 / 6, 3.4688, 4, 7.4076},
                             {0.1, 4.0736, 6, 9.5411}};
  for (const auto& [ratio, peak, peak_time, end] : table) {
    CAPTURE(ratio);
    const double step = 0.025e-6;
    const std::size_t cells = static_cast<std::size_t>(std::lround(2000 * std::max(1.0, 4 * ratio)));
    const double crossing = static_cast<double>(cells) * step;
    const UniformGrid grid{step, static_cast<std::size_t>(std::ceil(1.05 * end * static_cast<double>(cells))) + 1};
    const Bar bar = bars::rod_of_cells(cells, step, 0.02, {Face::a}, FarEnd::fixed);
    const double z = bars::impedance(bar);
    const std::vector<Response> bodies{mass_response(mass_kg(bar.profile) / ratio, grid), wave_response(bar, grid)};
    const ContactTrace trace = solve_contacts(bodies, rigid_problem({1, 0}, 1)).traces[0];
    const ContactInterval first = contact_intervals(trace, grid).front();
    CHECK(first.peak_force_N / z == about(peak).epsilon(1e-3));
    CHECK(first.peak_time_s / crossing == about(peak_time).epsilon(1e-3));
    CHECK(first.end_s / crossing == about(end).epsilon(1e-3));
  }
}

TEST_CASE("contacts_problem: a stiff spring converges to the rigid interface, at the rate of its own time constant") {
  const UniformGrid grid = grid_over(150e-6, 0.1e-6);
  const std::vector<Response> bodies{wave_response(bars::steel_rod(0.5), grid), wave_response(bars::long_rod(), grid)};
  const double plateau = bars::impedance(bars::long_rod()) / 2;
  std::vector<double> lost;
  for (double stiffness : {1e8, 2e8, 4e8, 8e8}) {
    ContactsProblem problem = rigid_problem({1, 0}, 1);
    problem.laws = {ContactLaw::linear(stiffness)};
    // F = plateau (1 - e^(-2kt/Z)): the impulse that is missing is plateau Z/(2k).
    lost.push_back(plateau * 150e-6 - solve_contacts(bodies, problem).traces[0].running_impulse_Ns.back());
    CHECK(lost.back() == about(plateau * plateau / stiffness).epsilon(2e-3));
  }
  CHECK(std::log2(lost[0] / lost[3]) / 3 == about(1).epsilon(0.01));
}

TEST_CASE("contacts_problem: TCB by rod theory touches again after its first release") {
  const UniformGrid grid = grid_over(1.3e-3, 0.5e-6);
  const ContactsSolution solution = solve_contacts(
      {wave_response(bars::cone(Face::b), grid), wave_response(bars::long_rod(), grid)}, rigid_problem({0.93, 0}, 1));
  const ContactTrace& trace = solution.traces[0];
  const std::vector<ContactInterval> intervals = contact_intervals(trace, grid);
  REQUIRE(intervals.size() == 3);  // the third begins at 1286 us, 14 us before the end
  CHECK(intervals[1].start_s == about(597e-6).epsilon(0.001));
  CHECK(intervals[1].end_s == about(1025e-6).epsilon(0.001));
  CHECK(intervals[1].peak_force_N == about(407).epsilon(0.001));
  CHECK(intervals[1].impulse_Ns == about(0.1369).epsilon(0.001));
  CHECK(intervals[0].impulse_Ns == about(0.8246).epsilon(0.0005));
  CHECK(solution.energy_error < 2e-3);
}

TEST_CASE(
    "contacts_problem: a rigid beam on two unlike supports, each contact free to part, against Newmark's method") {
  // Body 1: mass 0.5 kg, rotary inertia as a second rigid mode, contacts at its ends. Body 2: two masses on springs,
  // one contact each.
  ModalModel beam{Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(2), Eigen::MatrixXd(2, 2),
                  Eigen::MatrixXd::Zero(2, 2), Eigen::MatrixXd::Zero(2, 2)};
  beam.participation << 1.4, 1.4, 2.0, -2.0;
  ModalModel supports{Eigen::VectorXd(2), Eigen::VectorXd::Zero(2), Eigen::MatrixXd(2, 2), Eigen::MatrixXd::Zero(2, 2),
                      Eigen::MatrixXd::Zero(2, 2)};
  supports.angular_frequency << 900, 2500;
  supports.participation << 2.2, 0, 0, 3.0;
  const double k = 3e5, speed = 1;
  const auto marched = [&](double step) {
    const UniformGrid grid = grid_over(6e-3, step);
    ContactsProblem problem = rigid_problem({speed, 0}, 2);
    problem.laws = {ContactLaw::linear(k), ContactLaw::linear(k)};
    problem.gaps_m = {0, 0.2e-3};
    return solve_contacts({modal_response(beam, grid), modal_response(supports, grid)}, problem);
  };
  // Newmark (average acceleration) in the four modal coordinates, fixed-point iteration on the unilateral springs, at a
  // fine step.
  const double h = 1e-6;
  const Eigen::Vector4d w2(0, 0, 900.0 * 900.0, 2500.0 * 2500.0);
  Eigen::Matrix<double, 4, 2> c;
  c << 1.4, 1.4, 2.0, -2.0, 2.2, 0, 0, 3.0;
  Eigen::Vector4d q = Eigen::Vector4d::Zero(), v = q, a = q;
  Eigen::Vector2d impulse = Eigen::Vector2d::Zero(), force = impulse, force_before = impulse;
  const Eigen::Vector2d gap(0, 0.2e-3);
  std::vector<double> newmark[2];
  for (int n = 0; n <= 6000; ++n) {
    for (int i : {0, 1}) newmark[i].push_back(force(i));
    const double t = (n + 1) * h;
    force_before = force;
    Eigen::Vector4d qn, an;
    for (int iteration = 0; iteration < 40; ++iteration) {
      an = ((c * force) - w2.cwiseProduct(q + h * v + 0.25 * h * h * a)).array() / (1 + 0.25 * h * h * w2.array());
      qn = q + h * v + 0.25 * h * h * (a + an);
      for (int i : {0, 1}) force(i) = std::max(0.0, k * (speed * t - gap(i) - c.col(i).dot(qn)));
    }
    v += 0.5 * h * (a + an);
    q = qn;
    a = an;
    impulse += 0.5 * h * (force + force_before);
  }
  std::vector<double> error;
  for (double step : {40e-6, 20e-6, 10e-6}) {
    const ContactsSolution solution = marched(step);
    double worst = 0;
    for (std::size_t contact : {0u, 1u})
      for (std::size_t n = 0; n < solution.traces[contact].force_N.size(); ++n)
        worst = std::max(worst, std::abs(solution.traces[contact].force_N[n] -
                                         newmark[contact][n * static_cast<std::size_t>(std::lround(step / h))]));
    error.push_back(worst / largest_force(solution.traces[0]));
    CHECK(solution.energy_error < 1e-10);
    // One point leaves and comes back while the other bears.
    CHECK(contact_intervals(solution.traces[0], {step, solution.traces[0].force_N.size()}).size() >= 1);
  }
  CHECK(error[2] < 2e-3);
  CHECK(std::log2(error[0] / error[2]) / 2 > 1.7);
}

TEST_CASE("contacts_problem: momentum and energy of two free bodies") {
  const UniformGrid grid = grid_over(400e-6, 0.2e-6);
  ContactsProblem problem = rigid_problem({1.2, -0.4}, 1);
  problem.laws = {ContactLaw::hertz(2e9)};
  const ContactTrace trace =
      solve_contacts({wave_response(bars::steel_rod(0.3), grid), wave_response(bars::steel_rod(0.2), grid)}, problem)
          .traces[0];
  CHECK_FALSE(trace.in_contact.back());
  // What body 1 gave, body 2 and the contact got; the contact gave it all back.
  CHECK(std::abs(trace.work_1_J.back() + trace.work_2_J.back()) < 1e-9 * std::abs(trace.work_1_J.back()));
  for (std::size_t k = 0; k < grid.size; ++k)
    CHECK(std::abs(trace.displacement_1_m[k] - trace.displacement_2_m[k] - trace.indentation_m[k]) < 1e-14);
}

TEST_CASE("contacts_problem: refuses bodies that do not fit") {
  const UniformGrid grid = grid_over(100e-6, 1e-6);
  const Response two_faced = wave_response(bars::rod_of_cells(20, 1e-6, 0.02, {Face::a, Face::b}), grid);
  const Response one_faced = wave_response(bars::steel_rod(0.2), grid);
  const auto solve = [](const std::vector<Response>& bodies, const ContactsProblem& problem) {
    static_cast<void>(solve_contacts(bodies, problem));
  };
  CHECK_THROWS_WITH_AS(solve({one_faced, one_faced, one_faced}, rigid_problem({1, 0, 0}, 2)),
                       doctest::Contains("an inner body has an entry and an exit"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(solve({one_faced, two_faced}, rigid_problem({1, 0}, 1)), doctest::Contains("1 and 2 contacts"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(
      solve({one_faced, wave_response(bars::steel_rod(0.2), grid_over(100e-6, 2e-6))}, rigid_problem({1, 0}, 1)),
      doctest::Contains("different grids"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(solve({one_faced, one_faced}, rigid_problem({1, 0}, 2)),
                       doctest::Contains("2 contact laws for 1 contacts"), std::invalid_argument);
}
