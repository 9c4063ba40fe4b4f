#include "impulse/contact/modal_history.hpp"

#include "impulse/contact/contacts_problem.hpp"
#include "impulse/response/wave_response.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace impulse;

namespace {

/// Rigid-body modes, then elastic ones from far below to beyond the Nyquist frequency of 1 µs, some damped, a static
/// flexibility besides.
ModalModel body_of(Eigen::Index elastic, Eigen::Index contacts, double residual = 0) {
  std::mt19937 random(20240611);
  std::uniform_real_distribution<double> part(-2, 2);
  const Eigen::Index modes = elastic + contacts;
  ModalModel body{Eigen::VectorXd::Zero(modes), Eigen::VectorXd::Zero(modes), Eigen::MatrixXd::Zero(modes, contacts),
                  residual * Eigen::MatrixXd::Identity(contacts, contacts), Eigen::MatrixXd::Zero(contacts, contacts)};
  for (Eigen::Index m = 0; m < modes; ++m) {
    if (m >= contacts) {
      const double place = static_cast<double>(m - contacts) / static_cast<double>(elastic);
      body.angular_frequency(m) = 300 * std::pow(2e4, place);
      body.damping_ratio(m) = m % 3 == 0 ? 0.0 : 0.3 * place;
    }
    for (Eigen::Index i = 0; i < contacts; ++i) body.participation(m, i) = part(random);
  }
  return body;
}

/// w_ij of a body by second differences of its U, in long double: of the double values they would be rounding.
std::vector<double> exact_kernel(const ModalModel& body, Eigen::Index i, Eigen::Index j, const UniformGrid& grid) {
  const auto u_at = [&](std::size_t k) {
    const long double t = static_cast<long double>(grid.step_s) * static_cast<long double>(k);
    long double sum = 0;
    for (Eigen::Index m = 0; m < body.mode_count(); ++m) {
      const long double omega = body.angular_frequency(m), zeta = body.damping_ratio(m);
      const long double p = static_cast<long double>(body.participation(m, i)) * body.participation(m, j);
      const long double root = std::sqrt(1 - zeta * zeta), x = omega * root * t;
      sum += omega == 0
                 ? p * t * t / 2
                 : p / (omega * omega) * (1 - std::exp(-zeta * omega * t) * (std::cos(x) + zeta / root * std::sin(x)));
    }
    return sum;
  };
  std::vector<double> w(grid.size - 1);
  long double before = 0, here = 0;
  for (std::size_t k = 0; k < w.size(); ++k) {
    const long double next = u_at(k + 1);
    w[k] = static_cast<double>((next - 2 * here + before) / static_cast<long double>(grid.step_s));
    before = here;
    here = next;
  }
  return w;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (double value : values) most = std::max(most, std::abs(value));
  return most;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = a.size() == b.size() ? 0 : HUGE_VAL;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

ContactsProblem problem_of(const std::vector<double>& speeds, const std::vector<ContactLaw>& laws) {
  ContactsProblem problem;
  problem.speed_m_per_s = speeds;
  problem.laws = laws;
  problem.gaps_m.assign(laws.size(), 0.0);
  problem.recontact = Recontact::yes;
  return problem;
}

/// Every column of every contact, of both histories, to `tolerance` of its largest value.
void check_same(const ContactsSolution& modes, const ContactsSolution& convolution, double tolerance) {
  CHECK(modes.history == HistoryMethod::modes);
  CHECK(convolution.history == HistoryMethod::convolution);
  REQUIRE(modes.traces.size() == convolution.traces.size());
  for (std::size_t c = 0; c < modes.traces.size(); ++c) {
    CAPTURE(c);
    const ContactTrace& a = modes.traces[c];
    const ContactTrace& b = convolution.traces[c];
    CHECK(largest(b.force_N) > 0);
    for (const auto column : {&ContactTrace::force_N, &ContactTrace::running_impulse_Ns, &ContactTrace::indentation_m,
                              &ContactTrace::stored_J, &ContactTrace::dissipated_J, &ContactTrace::velocity_1_m_per_s,
                              &ContactTrace::velocity_2_m_per_s, &ContactTrace::displacement_1_m,
                              &ContactTrace::displacement_2_m, &ContactTrace::work_1_J, &ContactTrace::work_2_J})
      CHECK(largest_difference(a.*column, b.*column) <= tolerance * largest(b.*column));
    CHECK(a.in_contact == b.in_contact);
  }
}

/// Both histories of the same question.
void check_histories_agree(const std::vector<ContactBody>& bodies, const UniformGrid& grid, ContactsProblem problem,
                           double tolerance) {
  problem.history = HistoryMethod::modes;
  const ContactsSolution modes = solve_contacts(bodies, grid, problem);
  problem.history = HistoryMethod::convolution;
  check_same(modes, solve_contacts(bodies, grid, problem), tolerance);
}

}  // namespace

TEST_CASE("modal_history: its kernel is the second difference of the displacement under a step force") {
  const UniformGrid grid = grid_over(1e-3, 1e-6);
  for (Eigen::Index contacts : {1, 2, 3}) {
    CAPTURE(contacts);
    const ModalModel body = body_of(37, contacts, 1e-9);
    const auto p = static_cast<std::size_t>(contacts);
    for (std::size_t j = 0; j < p; ++j) {
      ModalHistory history(body, grid.step_s);
      std::vector<std::vector<double>> kernel(p);
      std::vector<double> force(p, 0.0);
      force[j] = 1;  // a unit force in the first step alone
      for (std::size_t i = 0; i < kernel.size(); ++i) {
        CHECK(history.past(i) == 0);
        kernel[i].push_back(history.within_step(i, j));
      }
      for (std::size_t n = 1; n + 1 < grid.size; ++n) {
        history.push(force);
        force[j] = 0;
        for (std::size_t i = 0; i < kernel.size(); ++i) kernel[i].push_back(history.past(i));
      }
      for (std::size_t i = 0; i < p; ++i) {
        const std::vector<double> exact =
            exact_kernel(body, static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j), grid);
        // λ is rounded once and raised to the power of the step count: some 1000 ε, more where products of
        // participations cancel.
        CHECK(largest_difference(kernel[i], exact) < 3e-12 * largest(exact));
      }
    }
  }
}

TEST_CASE("modal_history: is the direct O(N²) sum to rounding") {
  const UniformGrid grid = grid_over(1.5e-3, 1e-6);
  const ModalModel body = body_of(29, 2);
  std::vector<std::vector<double>> w;
  for (Eigen::Index i : {0, 1})
    for (Eigen::Index j : {0, 1}) w.push_back(exact_kernel(body, i, j, grid));
  ModalHistory history(body, grid.step_s);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<std::vector<double>> x(2);
  double worst = 0, scale = 0;
  for (std::size_t n = 0; n + 1 < grid.size; ++n) {
    for (std::size_t i : {0u, 1u}) {
      double direct = 0;
      for (std::size_t k = 0; k < n; ++k) direct += w[2 * i][n - k] * x[0][k] + w[2 * i + 1][n - k] * x[1][k];
      worst = std::max(worst, std::abs(history.past(i) - direct));
      scale = std::max(scale, std::abs(direct));
    }
    const std::vector<double> forces{any(random), any(random)};
    for (std::size_t i : {0u, 1u}) x[i].push_back(forces[i]);
    history.push(forces);
  }
  CHECK(worst < 1e-12 * scale);
}

TEST_CASE("modal_history: a mode that has decayed is forgotten, one that rests stays at rest") {
  ModalModel body = body_of(3, 1);
  body.damping_ratio.tail(3).setConstant(0.9);
  body.participation.topRows(1).setZero();  // no rigid-body motion
  ModalHistory history(body, 1.0);
  const double once = 1, never = 0;
  history.push({&once, 1});
  CHECK(history.past(0) != 0);
  for (int n = 0; n < 3000; ++n) history.push({&never, 1});
  CHECK(history.past(0) == 0);
}

TEST_CASE(
    "modal_history: every law, preload, re-contact and residual flexibility march alike by modes and convolution") {
  const UniformGrid grid = grid_over(4e-3, 1e-6);
  const ModalModel striker = body_of(5, 1), target = body_of(23, 1), yielding = body_of(23, 1, 2e-8);
  for (const ContactLaw& law : {ContactLaw::linear(2e5), ContactLaw::hertz(3e8), ContactLaw::tan_sun(3e8, 0.094, 1e-5),
                                ContactLaw::table({{0, 5e-3, 1e-2}, {0, 1000, 2000}, {0, 300, 2000}})})
    for (const ModalModel* body : {&target, &yielding})
      check_histories_agree({striker, *body}, grid, problem_of({1.5, 0}, {law}), 1e-9);
  // A rigid contact with a residual flexibility is its spring.
  check_histories_agree({striker, yielding}, grid, problem_of({1.5, -0.1}, {ContactLaw::rigid()}), 1e-9);
  ContactsProblem pressed = problem_of({0, 0}, {ContactLaw::linear(2e5)});
  pressed.preload_N = 40;
  for (std::size_t n = 0; n < grid.size; ++n)
    pressed.free_velocity_last_m_per_s.push_back(0.2 * std::sin(2e4 * grid.time_s(n)));
  check_histories_agree({striker, target}, grid, pressed, 1e-9);
}

TEST_CASE("modal_history: a rigid contact of bodies without residual flexibility, while it lasts") {
  // Re-contact of rigid faces magnifies rounding at each closing; the first contact does not.
  const UniformGrid grid = grid_over(1e-3, 1e-6);
  const ModalModel striker = body_of(5, 1), target = body_of(23, 1);
  ContactsProblem problem = problem_of({1.5, 0}, {ContactLaw::rigid()});
  problem.recontact = Recontact::no;
  check_histories_agree({striker, target}, grid, problem, 1e-8);
}

TEST_CASE("modal_history: rows, several points and sampled neighbours") {
  const UniformGrid grid = grid_over(1e-3, 1e-6);
  const ModalModel one = body_of(5, 1), two = body_of(17, 2), other = body_of(9, 2, 1e-8);
  const ContactLaw soft = ContactLaw::linear(2e5), hertz = ContactLaw::hertz(3e8);
  // A row: two contacts on the inner body.
  check_histories_agree({one, two, one}, grid, problem_of({1, 0, 0}, {soft, hertz}), 1e-9);
  // Two points of two bodies, the second after a gap.
  ContactsProblem points = problem_of({1, 0}, {soft, hertz});
  points.gaps_m = {0, 2e-5};
  check_histories_agree({two, other}, grid, points, 1e-9);
  // A row with a body of waves: only the others have modes.
  const Response rod = wave_response(bars::steel_rod(0.4), grid);
  check_histories_agree({one, two, rod}, grid, problem_of({1, 0, 0}, {soft, hertz}), 1e-9);
}

TEST_CASE("modal_history: automatic says what it took; modes are refused where there are none") {
  const UniformGrid grid = grid_over(1e-4, 1e-6);
  const ModalModel body = body_of(5, 1);
  const Response rod = wave_response(bars::steel_rod(0.4), grid);
  ContactsProblem problem = problem_of({1, 0}, {ContactLaw::linear(1e5)});
  CHECK(solve_contacts(std::vector<ContactBody>{body, body}, grid, problem).history == HistoryMethod::modes);
  CHECK(solve_contacts({rod, rod}, problem).history == HistoryMethod::convolution);
  problem.history = HistoryMethod::modes;
  CHECK_THROWS_WITH_AS(static_cast<void>(solve_contacts({rod, rod}, problem)),
                       doctest::Contains("no body is given by modes"), std::invalid_argument);
}

TEST_CASE("modal_history: an observer hears of the steps") {
  const UniformGrid grid = grid_over(5e-3, 1e-6);
  const ModalModel body = body_of(5, 1);
  ContactsProblem problem = problem_of({1, 0}, {ContactLaw::linear(1e5)});
  std::vector<double> heard;
  problem.progress = [&](double done) { heard.push_back(done); };
  static_cast<void>(solve_contacts(std::vector<ContactBody>{body, body}, grid, problem));
  REQUIRE(heard.size() == 4);
  CHECK(heard.front() == about(1024.0 / 5000));
  CHECK(heard.back() == about(4096.0 / 5000));
}
