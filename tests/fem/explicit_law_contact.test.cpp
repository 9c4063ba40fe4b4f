#include "fem/explicit/explicit_contact.hpp"

#include "fem/bodies/bar_structure.hpp"
#include "fem/bodies/mass_structure.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace impulse {
namespace {

const double steel_speed = parse_material("steel").rod_wave_speed_m_per_s();

Structure by_step(const Bar& bar, double step_s) { return bar_structure(bar, bar_mesh_by_step(bar, step_s)); }

/// A steel rod of impedance Z that goes on for ever; waves cross its twenty elements in `courant` of a step.
Structure endless_rod(double impedance, double step_s, double courant = 1) {
  const Material steel = parse_material("steel");
  const double section = impedance / std::sqrt(steel.youngs_modulus_Pa * steel.density_kg_per_m3);
  const double diameter = std::sqrt(4 * section / std::numbers::pi);
  const Bar rod = bars::steel_rod(20 * steel_speed * step_s / courant, FarEnd::infinite, diameter);
  return bar_structure(rod, bar_mesh_by_count(rod, 20));
}

/// A sphere on an endless rod, in the small-mass table's units.
struct Sphere {
  double mass = 0.0333, stiffness = 1.5e10, speed = 0.7, lambda = 0.5;
  [[nodiscard]] double time() const { return std::pow(mass / (stiffness * std::sqrt(speed)), 0.4); }
  [[nodiscard]] double impedance() const { return mass / (time() * lambda); }
  [[nodiscard]] ExplicitContactResult strike(const ContactLaw& law, double steps_per_unit, double units,
                                             double courant = 1, std::size_t subcycles = 1) const {
    const double step = time() / steps_per_unit;
    return explicit_contact(mass_structure(mass), endless_rod(impedance(), step, courant),
                            {.speed_m_per_s = speed,
                             .step_s = step,
                             .projectile_subcycles = subcycles,
                             .duration_s = units * time(),
                             .law = law});
  }
};

/// Peak by the parabola through the largest sample and its neighbours, and its time.
std::pair<double, double> peak_of(const ExplicitContactResult& result) {
  const std::vector<double>& f = result.trace.force_N;
  const auto k = static_cast<std::size_t>(std::max_element(f.begin(), f.end()) - f.begin());
  const double a = f[k - 1], b = f[k], c = f[k + 1], shift = 0.5 * (a - c) / (a - 2 * b + c);
  return {b - 0.25 * (a - c) * shift, (static_cast<double>(k) + shift) * result.grid.step_s};
}

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

/// Mean slope over the levels, whose steps halve.
double order(const std::vector<double>& errors) {
  return std::log2(errors.front() / errors.back()) / static_cast<double>(errors.size() - 1);
}

TEST_CASE("explicit law contact: two masses with a spring between: half a sine of the reduced mass, with order 2") {
  const double m1 = 0.3, m2 = 0.5, k = 2e6, v1 = 2, v2 = 0.5;
  const double reduced = m1 * m2 / (m1 + m2), omega = std::sqrt(k / reduced), peak = (v1 - v2) * std::sqrt(k * reduced);
  std::vector<double> force_errors, end_errors;
  for (const double per_contact : {20.3, 40.3, 80.3, 160.3}) {
    const double step = std::numbers::pi / omega / per_contact;
    const ExplicitContactResult result = explicit_contact(mass_structure(m1), mass_structure(m2),
                                                          {.speed_m_per_s = v1,
                                                           .speed_2_m_per_s = v2,
                                                           .step_s = step,
                                                           .duration_s = 2 * std::numbers::pi / omega,
                                                           .law = ContactLaw::linear(k)});
    double worst = 0;
    for (std::size_t n = 0; n < result.grid.size; ++n) {
      const double t = result.grid.time_s(n), exact = omega * t < std::numbers::pi ? peak * std::sin(omega * t) : 0;
      worst = std::max(worst, std::abs(result.trace.force_N[n] - exact));
    }
    force_errors.push_back(worst / peak);
    end_errors.push_back(std::abs(result.contact_end_s * omega / std::numbers::pi - 1));
    // Elastic: both leave with the speeds of a perfectly elastic collision, whatever the step.
    CHECK_FALSE(result.in_contact_at_end);
    CHECK(result.trace.running_impulse_Ns.back() == about(2 * reduced * (v1 - v2)).epsilon(1e-12));
    CHECK(result.trace.velocity_1_m_per_s.back() == about(v1 - 2 * reduced / m1 * (v1 - v2)).epsilon(1e-12));
    CHECK(result.trace.velocity_2_m_per_s.back() == about(v2 + 2 * reduced / m2 * (v1 - v2)).epsilon(1e-12));
    CHECK(result.energy_error <= 1e-6);
  }
  CHECK(std::abs(order(force_errors) - 2) <= 0.1);
  CHECK(std::abs(order(end_errors) - 2) <= 0.1);
}

TEST_CASE(
    "explicit law contact: a sphere on an endless rod has the peak, times and restitution of the small-mass table") {
  // σ'' + (1 + λ d/dτ) σ^1.5 = 0: restitution e, peak F̂, its time, the end; F = F̂ M V/ts.
  const double table[][5] = {{0.1, 0.84334, 1.03554, 1.56823, 3.2785},
                             {0.5, 0.43689, 0.75022, 1.43811, 3.6244},
                             {1, 0.18412, 0.55615, 1.32128, 4.3876},
                             {2, 0.02068, 0.36466, 1.16370, 8.4832}};
  for (const auto& [lambda, e, peak, peak_time, end] : table)
    for (const double courant : {1.0, 0.8}) {
      CAPTURE(lambda);
      Sphere sphere;
      sphere.lambda = lambda;
      const ExplicitContactResult fine = sphere.strike(ContactLaw::hertz(sphere.stiffness), 160, 1.2 * end, courant);
      const auto [force, time] = peak_of(fine);
      const double momentum = sphere.mass * sphere.speed;
      // The table has five digits.
      CHECK(force * sphere.time() / momentum == about(peak).epsilon(1e-4));
      CHECK(time / sphere.time() == about(peak_time).epsilon(1e-4));
      CHECK(fine.contact_end_s / sphere.time() == about(end).epsilon(1e-4));
      CHECK(std::abs(fine.trace.running_impulse_Ns.back() / momentum - 1 - e) <= 1e-5);
      CHECK(fine.trace.dissipated_J.back() == 0);
    }
}

TEST_CASE("explicit law contact: force, impulse and energy of a law converge with order 2") {
  const Sphere sphere{.lambda = 1};
  std::vector<double> peaks, impulses, energy;
  for (const double per_unit : {10.0, 20.0, 40.0, 80.0, 160.0, 320.0}) {
    const ExplicitContactResult result = sphere.strike(ContactLaw::hertz(sphere.stiffness), per_unit, 5.5);
    peaks.push_back(peak_of(result).first);
    impulses.push_back(result.trace.running_impulse_Ns.back());
    energy.push_back(result.energy_error);
  }
  const auto differences = [](const std::vector<double>& values) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(std::abs(values[i] - values[i - 1]));
    return steps;
  };
  CHECK(std::abs(order(differences(peaks)) - 2) <= 0.1);
  CHECK(std::abs(order(differences(impulses)) - 2) <= 0.1);
  CHECK(std::abs(order(energy) - 2) <= 0.1);
  CHECK(energy.back() <= 1e-6);
}

TEST_CASE("explicit law contact: what the bodies give up is stored or dissipated, to rounding, with subcycles too") {
  const Sphere sphere;
  const double arrived = 0.5 * sphere.mass * sphere.speed * sphere.speed;
  for (const ContactLaw& law :
       {ContactLaw::linear(1e8), ContactLaw::hertz(1.5e10), ContactLaw::tan_sun(1.5e10, 0.094, 1e-6)})
    for (const std::size_t subcycles : {1u, 3u})
      for (const double per_unit : {5.0, 40.0}) {
        const ContactTrace trace = sphere.strike(law, per_unit, 6, 1, subcycles).trace;
        double worst = 0;
        for (std::size_t n = 0; n < trace.force_N.size(); ++n)
          worst = std::max(worst,
                           std::abs(trace.work_1_J[n] + trace.work_2_J[n] + trace.stored_J[n] + trace.dissipated_J[n]));
        CHECK(worst <= 1e-11 * arrived);
        CHECK(largest(trace.stored_J) > 0.1 * arrived);
        CHECK(trace.stored_J.back() == 0);
      }
}

TEST_CASE("explicit law contact: Tan and Sun's law books what it loses") {
  const double k = 1.5e10, beta = 0.094, critical = 1e-6;
  const ExplicitContactResult result = Sphere{}.strike(ContactLaw::tan_sun(k, beta, critical), 40, 6);
  const double deepest = largest(result.trace.indentation_m), permanent = beta * (deepest - critical);
  const double lost = 0.4 * k * std::pow(deepest, 2.5) - 2.0 / 7 * k * std::pow(deepest, 1.5) * (deepest - permanent);
  CHECK(result.trace.dissipated_J.back() == about(lost).epsilon(1e-12));
  CHECK(lost > 0.1 * largest(result.trace.stored_J));
  // The contact opens at the permanent indentation, not at 0.
  const auto last = std::find(result.trace.in_contact.rbegin(), result.trace.in_contact.rend(), true);
  const auto n = static_cast<std::size_t>(result.trace.in_contact.rend() - last) - 1;
  CHECK(result.trace.indentation_m[n] > permanent);
  CHECK(result.trace.indentation_m[n + 1] <= permanent);
  CHECK(result.trace.force_N[n + 1] == 0);
}

TEST_CASE("explicit law contact: a spring tends to the rigid contact, up to the stiffness that the step resolves") {
  // A spring on a rod at Courant number 1 has no stable step at all if its force is taken explicitly.
  const Structure cone = by_step(bars::cone(), 5e-6), rod = by_step(bars::long_rod(), 5e-6);
  ExplicitContact contact{
      .speed_m_per_s = 1.16, .step_s = 5e-6, .duration_s = 1.2e-3, .after_contact = AfterContact::touch_again};
  const double rigid = explicit_contact(cone, rod, contact).trace.running_impulse_Ns.back();
  double apart = 1;
  for (const double stiffness : {3e7, 1e8, 3.5e8}) {
    CAPTURE(stiffness);
    contact.law = ContactLaw::linear(stiffness);
    const ExplicitContactResult result = explicit_contact(cone, rod, contact);
    CHECK(result.energy_error <= 0.01);
    const double now = std::abs(result.trace.running_impulse_Ns.back() / rigid - 1);
    CHECK(now < apart);
    apart = now;
  }
  CHECK(apart <= 0.01);
  // At Courant number 1 a unit force takes Δt (1/Z₁ + 1/Z₂) back within a step.
  const double ratio = 5e-6 * (cone.wave_admittance(0, 0) + rod.wave_admittance(0, 0));
  for (const ContactLaw& law : {ContactLaw::linear(2.2 / ratio), ContactLaw::hertz(5e12)}) {
    contact.law = law;
    CHECK_THROWS_WITH_AS((void)explicit_contact(cone, rod, contact),
                         doctest::Contains("contact 1: a step of 5e-06 s is too long for its law, which is so stiff "
                                           "that the force would alternate from step to step; use a step of "),
                         std::invalid_argument);
  }
  contact.law = ContactLaw::linear(1.9 / ratio);
  CHECK_NOTHROW((void)explicit_contact(cone, rod, contact));
}

TEST_CASE("explicit law contact: pressed together for long, a law keeps its energy, with any number of subcycles") {
  const double step = 10e-6;
  const Structure rod = by_step(bars::long_rod(), step);
  for (const std::size_t subcycles : {1u, 2u, 4u, 7u})
    for (const double stiffness : {1e7, 1.5e8}) {
      const ExplicitContactResult result =
          explicit_contact(by_step(bars::cone(), step / static_cast<double>(subcycles)), rod,
                           {.speed_m_per_s = 1.16,
                            .step_s = step,
                            .projectile_subcycles = subcycles,
                            .duration_s = 0.03,
                            .law = ContactLaw::linear(stiffness),
                            .after_contact = AfterContact::touch_again});
      CHECK(result.energy_error <= 0.02);
    }
}

}  // namespace
}  // namespace impulse
