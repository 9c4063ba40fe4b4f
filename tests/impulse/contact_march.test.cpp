#include "impulse/contact/contact_march.hpp"

#include "tests/support/about.hpp"
#include "tests/support/direct_sums.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <numeric>

using namespace impulse;

namespace {

/// Weights of U = t/Z + t²/(2m): a sphere of mass m on a semi-infinite rod of impedance Z.
std::vector<double> sphere_on_rod(double m, double z, const UniformGrid& grid) {
  std::vector<double> w(grid.size - 1);
  const auto u = [&](double k) {
    const double t = k * grid.step_s;
    return (std::isinf(z) ? 0 : t / z) + t * t / (2 * m);
  };
  w[0] = u(1) / grid.step_s;
  for (std::size_t k = 1; k < w.size(); ++k) {
    const double x = static_cast<double>(k);
    w[k] = (u(x + 1) - 2 * u(x) + u(x - 1)) / grid.step_s;
  }
  return w;
}

MarchedContact struck(const ContactLaw& law, double speed, const UniformGrid& grid) {
  MarchedContact contact;
  contact.law = law;
  contact.approach_m_per_s.assign(grid.size - 1, speed);
  return contact;
}

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

/// Peak by the parabola through the largest sample and its neighbours.
std::pair<double, double> peak_of(const std::vector<double>& f, double step) {
  const auto k = static_cast<std::size_t>(std::max_element(f.begin(), f.end()) - f.begin());
  const double a = f[k - 1], b = f[k], c = f[k + 1];
  const double shift = 0.5 * (a - c) / (a - 2 * b + c);
  return {b - 0.25 * (a - c) * shift, (static_cast<double>(k) + shift) * step};
}

}  // namespace

TEST_CASE("contact_march: a mass on a spring: V√(km) sin ωt for half a period, to order 2") {
  const double m = 0.3, k = 2e6, speed = 1.5;
  std::vector<double> error;
  for (double step : {8e-6, 4e-6, 2e-6, 1e-6}) {
    const UniformGrid grid = grid_over(2e-3, step);
    const auto result = march_contacts(grid, {struck(ContactLaw::linear(k), speed, grid)},
                                       {sphere_on_rod(m, HUGE_VAL, grid)}, Recontact::no);
    const double omega = std::sqrt(k / m);
    error.push_back(0);
    for (std::size_t n = 0; grid.time_s(n) < 0.99 * std::numbers::pi / omega; ++n)
      error.back() = std::max(
          error.back(), std::abs(result[0].force_N[n] / (speed * std::sqrt(k * m)) - std::sin(omega * grid.time_s(n))));
    // Elastic: it leaves with the speed it came with.
    const double impulse = step * std::accumulate(result[0].mean_force_N.begin(), result[0].mean_force_N.end(), 0.0);
    CHECK(impulse == about(2 * m * speed).epsilon(1e-10));
    CHECK(result[0].stored_J.back() == 0);
    CHECK_FALSE(result[0].in_contact.back());
  }
  CHECK(std::log2(error[0] / error[3]) / 3 == about(2).epsilon(0.05));
}

TEST_CASE("contact_march: sphere on a semi-infinite rod, every row of the small-mass table") {
  // σ'' + (1 + λ d/dτ) σ^1.5 = 0: restitution e, peak F̂, its time and the end, F = F̂ M V/ts, ts = (M/(k√V))^0.4, λ =
  // M/(ts Z).
  const double table[][5] = {{0, 1, 1.14326, 1.60903, 3.2181},          {0.1, 0.84334, 1.03554, 1.56823, 3.2785},
                             {0.25, 0.65765, 0.90678, 1.51410, 3.3876}, {0.5, 0.43689, 0.75022, 1.43811, 3.6244},
                             {1, 0.18412, 0.55615, 1.32128, 4.3876},    {1.5, 0.06640, 0.44087, 1.23346, 5.8363},
                             {2, 0.02068, 0.36466, 1.16370, 8.4832}};
  const double m = 0.0333, k = 1.5e10, v = 0.7;
  const double ts = std::pow(m / (k * std::sqrt(v)), 0.4);
  for (const auto& [lambda, e, peak, peak_time, end] : table) {
    CAPTURE(lambda);
    const double z = lambda == 0 ? HUGE_VAL : m / (ts * lambda);
    std::vector<double> peaks;
    for (double per_unit : {25.0, 50.0, 100.0, 200.0, 400.0}) {
      const UniformGrid grid = grid_over(1.2 * end * ts, ts / per_unit);
      const auto result =
          march_contacts(grid, {struck(ContactLaw::hertz(k), v, grid)}, {sphere_on_rod(m, z, grid)}, Recontact::no);
      const auto& f = result[0];
      const auto [force, time] = peak_of(f.force_N, grid.step_s);
      peaks.push_back(force * ts / (m * v));
      if (per_unit < 400) continue;
      CHECK(force * ts / (m * v) == about(peak).epsilon(1e-3));
      CHECK(time / ts == about(peak_time).epsilon(1e-3));
      const double impulse = grid.step_s * std::accumulate(f.mean_force_N.begin(), f.mean_force_N.end(), 0.0);
      CHECK(impulse / (m * v) - 1 == about(e).epsilon(1e-3));
      std::size_t last = 0;
      for (std::size_t n = 0; n < grid.size; ++n)
        if (f.in_contact[n]) last = n;
      const double a = f.indentation_m[last], b = f.indentation_m[last + 1];
      CHECK((static_cast<double>(last) + a / (a - b)) * grid.step_s / ts == about(end).epsilon(1e-3));
    }
    // The table has five digits: the order shows in the differences of successive steps.
    if (lambda > 0)  // without loss energy alone fixes the peak, whatever the step
      CHECK(std::log2((peaks[0] - peaks[1]) / (peaks[2] - peaks[3])) / 2 == about(2).epsilon(0.1));
  }
}

TEST_CASE("contact_march: work on the contact is what the law took up, whatever the step") {
  const double m = 0.0333, v = 0.7, z = 300;
  for (const ContactLaw& law :
       {ContactLaw::linear(1e8), ContactLaw::hertz(1.5e10), ContactLaw::tan_sun(1.5e10, 0.094, 1e-6)})
    for (double step : {4e-6, 1e-6}) {
      const UniformGrid grid = grid_over(400e-6, step);
      const auto f = march_contacts(grid, {struck(law, v, grid)}, {sphere_on_rod(m, z, grid)}, Recontact::yes)[0];
      double work = 0, worst = 0;
      for (std::size_t n = 0; n + 1 < grid.size; ++n) {
        work += f.mean_force_N[n] * (f.indentation_m[n + 1] - f.indentation_m[n]);
        worst = std::max(worst, std::abs(work - f.stored_J[n + 1] - f.dissipated_J[n + 1]));
      }
      CHECK(worst < 1e-10 * 0.5 * m * v * v);
      CHECK(largest(f.force_N) > 1);
    }
}

TEST_CASE("contact_march: equals direct marching to rounding, contacts coupled within the step or not") {
  const UniformGrid grid = grid_over(500e-6, 0.25e-6);
  const std::vector<double> w = sphere_on_rod(0.0333, 300, grid);
  std::vector<double> cross(w.size());
  for (std::size_t k = 0; k < w.size(); ++k) cross[k] = 0.2 * w[k] * std::exp(-1e-3 * static_cast<double>(k));
  const std::vector<MarchedContact> contacts{struck(ContactLaw::linear(5e7), 1, grid),
                                             struck(ContactLaw::linear(2e7), 0.5, grid)};
  const auto result = march_contacts(grid, contacts, {w, cross, cross, w}, Recontact::yes);
  // Direct: two linear springs; the mean force of a step in contact is k(α_n + α_{n+1})/2, so the step is a 2 by 2
  // system.
  double alpha[2] = {0, 0};
  std::vector<double> f[2];
  double worst = 0;
  for (std::size_t n = 0; n < w.size(); ++n) {
    double free[2];
    for (int i = 0; i < 2; ++i) {
      double history = 0;
      for (std::size_t k = 0; k < n; ++k) history += w[n - k] * f[i][k] + cross[n - k] * f[1 - i][k];
      free[i] = alpha[i] + grid.step_s * ((i == 0 ? 1.0 : 0.5) - history);
    }
    if (result[0].indentation_m[n + 1] <= 0 || result[1].indentation_m[n + 1] <= 0) break;  // until one separates
    const double c = grid.step_s * w[0], d = grid.step_s * cross[0], k0 = 5e7 / 2, k1 = 2e7 / 2;
    const double a00 = 1 + c * k0, a01 = d * k1, a10 = d * k0, a11 = 1 + c * k1;
    const double b0 = free[0] - c * k0 * alpha[0] - d * k1 * alpha[1],
                 b1 = free[1] - d * k0 * alpha[0] - c * k1 * alpha[1];
    const double det = a00 * a11 - a01 * a10;
    const double next0 = (b0 * a11 - a01 * b1) / det, next1 = (a00 * b1 - a10 * b0) / det;
    f[0].push_back(k0 * (alpha[0] + next0));
    f[1].push_back(k1 * (alpha[1] + next1));
    alpha[0] = next0;
    alpha[1] = next1;
    worst = std::max(
        {worst, std::abs(next0 - result[0].indentation_m[n + 1]), std::abs(next1 - result[1].indentation_m[n + 1])});
  }
  CHECK(f[0].size() > 300);
  CHECK(worst < 1e-12 * largest(result[0].indentation_m));
}

TEST_CASE("contact_march: a rigid contact is the step form of the contact equation, and opens once") {
  const UniformGrid grid = grid_over(300e-6, 1e-6);
  std::vector<double> w = sphere_on_rod(0.0333, 300, grid);
  for (std::size_t k = 100; k < w.size(); ++k) w[k] += 0.02;  // an echo that throws the bodies apart
  const auto f = march_contacts(grid, {struck(ContactLaw::rigid(), 1, grid)}, {w}, Recontact::yes)[0];
  const std::vector<double> stick = direct::toeplitz_solution(w, std::vector<double>(w.size(), 1.0));
  for (std::size_t n = 0; n < 100; ++n) CHECK(f.mean_force_N[n] == about(stick[n]).epsilon(1e-12));
  for (std::size_t n = 0; n < w.size(); ++n) {
    CHECK(f.mean_force_N[n] >= 0);
    CHECK(f.indentation_m[n + 1] <= 0);
    CHECK(f.mean_force_N[n] * f.indentation_m[n + 1] == 0);
  }
}

TEST_CASE("contact_march: a preload holds still until something moves it") {
  const UniformGrid grid = grid_over(200e-6, 1e-6);
  MarchedContact contact = struck(ContactLaw::linear(1e8), 0, grid);
  contact.preload_N = 500;
  const auto f = march_contacts(grid, {contact}, {sphere_on_rod(0.0333, 300, grid)}, Recontact::yes)[0];
  for (double force : f.force_N) CHECK(force == about(500).epsilon(1e-12));
}

TEST_CASE("contact_march: a step too long for a law is refused with one that is not") {
  // κ = Δt k/Z for a spring on a rod: the force alternates beyond κ = 2, and is smooth at the step of the message.
  const double z = 300, stiffness = 3e8 / 2, m = 1e3;
  const auto marched = [&](double step, const ContactLaw& law) {
    const UniformGrid grid = grid_over(60 * step, step);
    return march_contacts(grid, {struck(law, 1, grid)}, {sphere_on_rod(m, z, grid)}, Recontact::no)[0].force_N;
  };
  CHECK_NOTHROW(marched(3.9e-6, ContactLaw::linear(stiffness)));
  CHECK_THROWS_WITH_AS(marched(4.1e-6, ContactLaw::linear(stiffness)),
                       doctest::Contains("contact 1: a step of 4.1e-06 s is too long for its law, which is so stiff "
                                         "that the force would alternate from step to step; use a step of 2e-06 s"),
                       std::invalid_argument);
  const std::vector<double> f = marched(2e-6, ContactLaw::linear(stiffness));
  for (std::size_t n = 1; n < 8; ++n) CHECK(f[n] > f[n - 1]);
  // A rigid contact is no law; unloading, however steep, is not what a step has to resolve.
  CHECK_NOTHROW(marched(1e-4, ContactLaw::rigid()));
  const ContactLaw steep = ContactLaw::table({{0, 0.999e-4, 1e-4}, {0, 9.99, 10}, {0, 0, 10}});
  const UniformGrid grid = grid_over(1e-3, 1e-6);
  const auto bounced =
      march_contacts(grid, {struck(steep, 0.3, grid)}, {sphere_on_rod(1e-2, HUGE_VAL, grid)}, Recontact::no)[0];
  CHECK(bounced.dissipated_J.back() > 0.9 * 0.5 * 1e-2 * 0.09);
}

TEST_CASE("contact_march: refuses what cannot be marched") {
  const UniformGrid grid = grid_over(10e-6, 1e-6);
  const auto march = [&](const std::vector<MarchedContact>& contacts, const std::vector<std::vector<double>>& w) {
    static_cast<void>(march_contacts(grid, contacts, w, Recontact::no));
  };
  const MarchedContact contact = struck(ContactLaw::rigid(), 1, grid);
  CHECK_THROWS_WITH_AS(march({contact}, {std::vector<double>(10, 0.0)}), doctest::Contains("do not yield at all"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(march({contact, contact}, {std::vector<double>(10, 1.0)}),
                       doctest::Contains("2 contacts need 4 kernels, not 1"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(march({contact}, {std::vector<double>(9, 1.0)}), doctest::Contains("9 weights"),
                       std::invalid_argument);
}
