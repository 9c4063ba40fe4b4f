// The impulse-response method and explicit finite elements, which share no code beyond lib/, on the four published
// cases and others.
#include "fem/bodies/bar_structure.hpp"
#include "fem/bodies/dispersion_correction.hpp"
#include "fem/explicit/explicit_impact.hpp"
#include "impulse/contact/contact_equation.hpp"
#include "impulse/exact/bar_modes.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/wave_response.hpp"
#include "lib/series/series_comparison.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

using namespace impulse;

namespace {

struct Case {
  std::string id;
  Bar projectile;
  double speed;
};

const Case cases[] = {{"TCA", bars::cone(Face::a), 1.16},
                      {"TCB", bars::cone(Face::b), 0.93},
                      {"CCA", bars::composite(Face::a), 0.92},
                      {"CCB", bars::composite(Face::b), 1.01}};

ImpactHistory by_waves(const Case& c, double step, double duration = 1e-3) {
  const UniformGrid grid = grid_over(duration, step);
  return solve_contact(wave_response(c.projectile, grid), wave_response(bars::long_rod(), grid), {c.speed},
                       ContactMethod::product);
}

ExplicitImpactResult by_elements(const Case& c, double step, std::size_t subcycles,
                                 Matching matching = Matching::direct) {
  return explicit_impact(
      bar_structure(c.projectile, bar_mesh_by_step(c.projectile, step / static_cast<double>(subcycles))),
      bar_structure(bars::long_rod(), bar_mesh_by_step(bars::long_rod(), step)),
      {.speed_m_per_s = c.speed,
       .step_s = step,
       .projectile_subcycles = subcycles,
       .duration_s = 1e-3,
       .matching = matching});
}

/// Times at which the force jumps: fronts of the projectile that return to its face (the rod's echo comes later), and
/// their repetitions.
std::vector<double> jump_times(const Case& c) {
  std::vector<double> round_trips;
  for (const Segment& s : c.projectile.profile) round_trips.push_back(2 * s.travel_time_s());
  std::vector<double> times{0.0};
  for (double trip : round_trips) {
    const std::size_t known = times.size();
    for (std::size_t k = 0; k < known; ++k)
      for (double t = times[k] + trip; t < 1e-3; t += trip) times.push_back(t);
  }
  return times;
}

double difference(const ImpactHistory& reference, const ImpactHistory& other, std::vector<double> jumps,
                  std::size_t leave_out) {
  const UniformSeries force{reference.grid, reference.force_N};
  return series_difference(force, {other.grid, other.force_N},
                           {first_contact_end_s(force), std::move(jumps), leave_out})
      .relative_l2;
}

}  // namespace

TEST_CASE("cross: explicit finite elements at Courant number 1 within 0.5 % of the waves, jumps left out") {
  for (const Case& c : cases) {
    CAPTURE(c.id);
    // Steps of 0.05 µs: travel times are whole numbers of steps to 2e-3 and better.
    const ImpactHistory elements = by_elements(c, 0.05e-6, 1).history;
    CHECK(difference(elements, by_waves(c, 0.05e-6), jump_times(c), 3) < 0.005);
    CHECK(impulse_Ns(elements) == about(impulse_Ns(by_waves(c, 0.05e-6))).epsilon(1e-4));
  }
}

TEST_CASE("cross: the difference between the methods shrinks as both refine") {
  for (const Case& c : cases) {
    CAPTURE(c.id);
    // Jumps fall anywhere within a step, so single steps are irregular; over a factor of 16 the trend is not.
    const auto apart = [&](double step) {
      return difference(by_waves(c, step), by_elements(c, step, 1).history, {}, 0);
    };
    const double finest = apart(0.25e-6);
    CHECK(finest < 0.8 * apart(4e-6));
    CHECK(finest < 0.03);  // at the jumps, which each method smears in its own way
  }
}

TEST_CASE("cross: bisection and direct matching agree to 1e-9 of the peak, subcycled or not") {
  for (const Case& c : cases)
    for (std::size_t subcycles : {1u, 4u}) {
      const ImpactHistory direct = by_elements(c, 4e-6, subcycles, Matching::direct).history;
      const ImpactHistory bisected = by_elements(c, 4e-6, subcycles, Matching::bisection).history;
      const double peak = *std::max_element(direct.force_N.begin(), direct.force_N.end());
      double largest = 0;
      for (std::size_t k = 0; k < direct.force_N.size(); ++k)
        largest = std::max(largest, std::abs(direct.force_N[k] - bisected.force_N[k]));
      CHECK(largest < 1e-9 * peak);
    }
}

TEST_CASE("cross: momentum of the elements is the impulse to rounding") {
  for (const Case& c : cases) {
    const ExplicitImpactResult result = by_elements(c, 1e-6, 2);
    const double impulse = impulse_Ns(result.history);
    const double mass = mass_kg(c.projectile.profile);
    CHECK(result.target.momentum_Ns == about(impulse).epsilon(1e-12));
    CHECK(std::abs(mass * c.speed - result.projectile.momentum_Ns - impulse) < 1e-12 * mass * c.speed);
  }
}

TEST_CASE("cross: momentum summed over the nodes of a modal body is the impulse of the contact equation's force") {
  // Each mode of a finite-element cone is driven by the piecewise linear force with its exact recurrence; its nodal
  // velocities, weighed with the nodal masses, must carry what the force gave.
  const Bar bar = bars::cone();
  const Structure structure = bar_structure(bar, bar_mesh_by_count(bar, 40));
  const UniformGrid grid = grid_over(1e-3, 2e-6);
  const Response projectile = modal_response(modal_model(structure), grid);
  const ImpactHistory history =
      solve_contact(projectile, wave_response(bars::long_rod(), grid), {1.16}, ContactMethod::product);

  const Eigen::MatrixXd m(structure.mass);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(Eigen::MatrixXd(structure.stiffness), m);
  const Eigen::VectorXd omega = modes.eigenvalues().cwiseMax(0).cwiseSqrt();
  const Eigen::VectorXd phi = modes.eigenvectors().transpose() * structure.contacts.col(0);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(omega.size());
  Eigen::VectorXd rate = q;
  double impulse = 0;
  for (std::size_t k = 0; k + 1 < grid.size; ++k) {
    const double f = history.force_N[k];
    const double slope = (history.force_N[k + 1] - f) / grid.step_s;
    const double t = grid.step_s;
    impulse += 0.5 * t * (f + history.force_N[k + 1]);
    for (Eigen::Index i = 0; i < omega.size(); ++i) {
      const double w = omega(i);
      if (w < 1) {  // rad/s: the rigid-body mode
        q(i) += rate(i) * t + phi(i) * (f * t * t / 2 + slope * t * t * t / 6);
        rate(i) += phi(i) * (f * t + slope * t * t / 2);
        continue;
      }
      const double c = std::cos(w * t), s = std::sin(w * t), p = phi(i) / (w * w);
      const double a = q(i) - p * f, b = (rate(i) - p * slope) / w;
      q(i) = a * c + b * s + p * (f + slope * t);
      rate(i) = w * (b * c - a * s) + p * slope;
    }
  }
  const Eigen::VectorXd velocity = modes.eigenvectors() * rate;
  const double momentum = (m * velocity).sum();
  CHECK(impulse > 0.5);
  CHECK(std::abs(momentum - impulse) < 1e-9 * impulse);
}

TEST_CASE("cross: modes of finite elements approach the exact ones, corrected ones at once") {
  const Bar bar = bars::composite();
  const ModalModel exact = exact_bar_modes(bar, {.count = 12});
  double before = 0;
  for (std::size_t elements : {34u, 68u, 136u, 272u}) {
    const BarMesh mesh = bar_mesh_by_count(bar, elements);
    const ModalModel plain = modal_model(bar_structure(bar, mesh), {.mode_count = 12});
    const ModalModel corrected = dispersion_corrected(plain, bar, mesh, 1e9);
    const double error = std::abs(plain.angular_frequency(11) / exact.angular_frequency(11) - 1);
    const double rest = std::abs(corrected.angular_frequency(11) / exact.angular_frequency(11) - 1);
    if (before > 0) CHECK(std::log2(before / error) == about(2).epsilon(0.05));
    CHECK(rest < 0.1 * error);
    before = error;
  }
}
