#include "fem/explicit/explicit_contact.hpp"

#include "fem/bodies/bar_structure.hpp"
#include "fem/bodies/mass_structure.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace impulse {
namespace {

const double steel_speed = parse_material("steel").rod_wave_speed_m_per_s();

Structure by_step(const Bar& bar, double step_s) { return bar_structure(bar, bar_mesh_by_step(bar, step_s)); }

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

/// Mean slope over the levels, whose steps halve.
double order(const std::vector<double>& errors) {
  return std::log2(errors.front() / errors.back()) / static_cast<double>(errors.size() - 1);
}

ExplicitContactResult tcb(double step_s, std::size_t subcycles, AfterContact after, double duration_s = 1.2e-3) {
  return explicit_contact(by_step(bars::cone(Face::b), step_s / static_cast<double>(subcycles)),
                          by_step(bars::long_rod(), step_s),
                          {.speed_m_per_s = 0.93,
                           .step_s = step_s,
                           .projectile_subcycles = subcycles,
                           .duration_s = duration_s,
                           .after_contact = after});
}

TEST_CASE("explicit_contact: each body's momentum is the running impulse, whatever the law, the gap and the contacts") {
  const double mass = mass_kg(bars::cone().profile), v1 = 1.2, v2 = 0.27;
  for (const ContactLaw& law : {ContactLaw::rigid(), ContactLaw::linear(3e8), ContactLaw::hertz(2e10)})
    for (const std::size_t subcycles : {1u, 2u, 5u})
      for (const AfterContact after : {AfterContact::go_on, AfterContact::touch_again}) {
        const double step = 7e-6;
        const Structure target = by_step(bars::long_rod(), step);
        const ExplicitContactResult result =
            explicit_contact(by_step(bars::cone(Face::b), step / static_cast<double>(subcycles)), target,
                             {.speed_m_per_s = v1,
                              .speed_2_m_per_s = v2,
                              .step_s = step,
                              .projectile_subcycles = subcycles,
                              .duration_s = 1.3e-3,
                              .gap_m = 15e-6,
                              .law = law,
                              .after_contact = after});
        const double impulse = result.trace.running_impulse_Ns.back();
        CHECK(std::abs(result.projectile.momentum_Ns - (mass * v1 - impulse)) <= 1e-12 * mass * v1);
        const double arrived = v2 * mass_kg(bars::long_rod().profile);
        CHECK(std::abs(result.target.momentum_Ns - (arrived + impulse)) <= 1e-12 * (mass * v1 + arrived));
        const std::size_t periods = contact_intervals(result.trace, result.grid).size();
        CHECK((after == AfterContact::go_on ? periods == 1 : periods > 1));
      }
}

TEST_CASE("explicit_contact: only the speed of approach matters") {
  for (const ContactLaw& law : {ContactLaw::rigid(), ContactLaw::hertz(2e10)}) {
    const Structure cone = by_step(bars::cone(), 5e-6), rod = by_step(bars::long_rod(), 5e-6);
    ExplicitContact contact{.speed_m_per_s = 1, .step_s = 5e-6, .duration_s = 1.2e-3, .law = law};
    const ExplicitContactResult rest = explicit_contact(cone, rod, contact);
    contact.speed_m_per_s = -3;
    contact.speed_2_m_per_s = -4;
    const ExplicitContactResult moving = explicit_contact(cone, rod, contact);
    for (std::size_t n = 0; n < rest.grid.size; ++n) {
      const double t = rest.grid.time_s(n), impulse = rest.trace.running_impulse_Ns[n];
      REQUIRE(moving.trace.force_N[n] == rest.trace.force_N[n]);
      REQUIRE(std::abs(moving.trace.velocity_1_m_per_s[n] - rest.trace.velocity_1_m_per_s[n] + 4) <= 1e-14);
      REQUIRE(std::abs(moving.trace.displacement_2_m[n] - rest.trace.displacement_2_m[n] + 4 * t) <= 1e-17);
      REQUIRE(std::abs(moving.trace.work_1_J[n] - (rest.trace.work_1_J[n] + 4 * impulse)) <= 1e-12);
    }
    const double arrived = 0.5 * mass_kg(bars::cone().profile) * 9 + 0.5 * mass_kg(bars::long_rod().profile) * 16;
    const double left = moving.projectile.kinetic_energy_J + moving.projectile.strain_energy_J +
                        moving.target.kinetic_energy_J + moving.target.strain_energy_J;
    CHECK(left == about(arrived).epsilon(1e-3));
    CHECK(moving.energy_error == rest.energy_error);
  }
}

TEST_CASE("explicit_contact: the cone of case TCB touches the rod again") {
  // Rod theory: released at 512.7 us, together again from 597 to 1025 us with up to 407 N and 17 % of the impulse.
  for (const std::size_t subcycles : {1u, 4u})
    for (const double step_us : {1.0, 0.5, 0.25}) {
      CAPTURE(step_us);
      const ExplicitContactResult result = tcb(step_us * 1e-6, subcycles, AfterContact::touch_again);
      const std::vector<ContactInterval> periods = contact_intervals(result.trace, result.grid);
      REQUIRE(periods.size() == 2);
      CHECK(std::abs(periods[0].end_s - 512.7e-6) <= 1.01 * step_us * 1e-6);
      // The release leaves the faces trembling from step to step, so that they meet a step or two early or late.
      CHECK(std::abs(periods[1].start_s - 597e-6) <= 2.1e-6 * step_us);
      CHECK(std::abs(periods[1].end_s - 1025e-6) <= 0.6e-6);
      CHECK(periods[0].impulse_Ns == about(0.8246).epsilon(4e-4));
      CHECK(periods[1].impulse_Ns == about(0.1369).epsilon(4e-3));
      CHECK(periods[1].impulse_Ns / periods[0].impulse_Ns == about(0.166).epsilon(5e-3));
      // Without subcycles the wake of the shortest waves adds 1 % to the peak.
      CHECK(periods[1].peak_force_N == about(407).epsilon(subcycles == 1 ? 0.013 : 0.003));
    }
}

TEST_CASE("explicit_contact: while closed the faces move together and do no net work, while open they do not overlap") {
  const double step = 1e-6;
  const ExplicitContactResult result = tcb(step, 1, AfterContact::touch_again, 2e-3);
  const ContactTrace& trace = result.trace;
  double worst = 0, overlap = 0, net = 0, tension = 0;
  for (std::size_t n = 0; n < result.grid.size; ++n) {
    const double difference = std::abs(trace.velocity_1_m_per_s[n] - trace.velocity_2_m_per_s[n]);
    // A sample or two without force within a contact: wave fronts, at which the faces part by a hair.
    if (trace.in_contact[n] && trace.force_N[n] > 0)
      worst = std::max({worst, difference, std::abs(trace.indentation_m[n])});
    else
      overlap = std::max(overlap, trace.indentation_m[n]);
    net = std::max(net, std::abs(trace.work_1_J[n] + trace.work_2_J[n]));
    tension = std::min(tension, trace.force_N[n]);
  }
  CHECK(worst <= 1e-12);
  CHECK(overlap <= 0.1 * 0.93 * step);
  CHECK(tension == 0);
  // But for a release inside a step, when they already part.
  CHECK(net <= 1e-4 * 0.93 * trace.running_impulse_Ns.back());
  // The first touch costs half a step; closing again does not: velocities agree at the sample where the force acts.
  const double jump = trace.force_N[0] * step / (4 * trace.running_impulse_Ns.back());
  CHECK(result.energy_error == about(jump).epsilon(0.03));
}

TEST_CASE("explicit_contact: the energy error of an impact counts the force that acted, not the tension found after") {
  const ExplicitContactResult result = tcb(2e-6, 1, AfterContact::go_on);
  const double jump = result.trace.force_N[0] * 2e-6 / (4 * result.trace.running_impulse_Ns.back());
  CHECK(result.energy_error == about(jump).epsilon(0.02));
}

TEST_CASE("explicit_contact: two equal rods never touch again") {
  const Bar rod = bars::steel_rod(0.5);
  const Structure body = bar_structure(rod, bar_mesh_by_count(rod, 40));
  const double step = 0.5 / steel_speed / 40;
  for (const ContactLaw& law : {ContactLaw::rigid(), ContactLaw::linear(1e8)}) {
    const ExplicitContactResult result = explicit_contact(body, body,
                                                          {.speed_m_per_s = 1,
                                                           .step_s = step,
                                                           .duration_s = 2000 * step,
                                                           .law = law,
                                                           .after_contact = AfterContact::touch_again});
    CHECK(contact_intervals(result.trace, result.grid).size() == 1);
    CHECK(result.trace.indentation_m.back() < -0.9 * (result.grid.duration_s() - 110 * step));
  }
  // Rigid: on the sample where both waves come back the force is the mean of compression and as much tension, none.
  const ExplicitContactResult rigid = explicit_contact(
      body, body,
      {.speed_m_per_s = 1, .step_s = step, .duration_s = 2000 * step, .after_contact = AfterContact::touch_again});
  CHECK(rigid.contact_end_s == about(80 * step).epsilon(1e-9));
  CHECK(rigid.projectile.momentum_Ns == about(mass_kg(rod.profile) / 160).epsilon(1e-9));
}

TEST_CASE("explicit_contact: a gap delays everything") {
  const Structure cone = by_step(bars::cone(), 2e-6), rod = by_step(bars::long_rod(), 2e-6);
  ExplicitContact contact{.speed_m_per_s = 1, .step_s = 2e-6, .duration_s = 1.0e-3, .law = ContactLaw::hertz(2e10)};
  const ExplicitContactResult touching = explicit_contact(cone, rod, contact);
  contact.gap_m = 50 * 1 * 2e-6;
  contact.duration_s = 1.1e-3;
  const ExplicitContactResult apart = explicit_contact(cone, rod, contact);
  const double peak = largest(touching.trace.force_N);
  for (std::size_t n = 0; n < touching.grid.size; ++n) {
    REQUIRE(std::abs(apart.trace.force_N[n + 50] - touching.trace.force_N[n]) <= 1e-9 * peak);
    REQUIRE(std::abs(apart.trace.indentation_m[n + 50] - touching.trace.indentation_m[n]) <= 1e-15);
  }
  CHECK(apart.contact_end_s == about(touching.contact_end_s + 1e-4).epsilon(1e-9));
  // A gap that the record is too short for.
  contact.gap_m = 1;
  const ExplicitContactResult never = explicit_contact(cone, rod, contact);
  CHECK(largest(never.trace.force_N) == 0);
  CHECK_FALSE(never.in_contact_at_end);
  CHECK(never.energy_error == 0);
  CHECK(never.contact_end_s == 0);
}

TEST_CASE("explicit_contact: rigid rods across a gap push with V Z/2 from the sample that closes it, for 2L/c") {
  const Bar rod = bars::steel_rod(0.5);
  const Bar longer = bars::steel_rod(1.5);
  const Structure body = bar_structure(rod, bar_mesh_by_count(rod, 40));
  const Structure target = bar_structure(longer, bar_mesh_by_count(longer, 120));
  const double step = 0.5 / steel_speed / 40, force = 0.5 * face_impedance_kg_per_s(rod.profile, Face::a);
  for (const double gap_steps : {10.0, 9.7, 10.3}) {
    const ExplicitContactResult result = explicit_contact(
        body, target, {.speed_m_per_s = 1, .step_s = step, .duration_s = 200 * step, .gap_m = gap_steps * step});
    for (std::size_t n = 0; n < result.grid.size; ++n) {
      // The waves come back on a sample, where the force is the mean of both sides.
      const double exact = n < 10 || n > 90 ? 0 : n == 90 ? 0.5 * force : force;
      REQUIRE(std::abs(result.trace.force_N[n] - exact) <= 1e-11 * force);
    }
    CHECK(result.trace.running_impulse_Ns.back() == about(mass_kg(rod.profile)).epsilon(1e-11));
    // A jump of the force on a sample costs half a step of work.
    CHECK(result.energy_error == about(0.25 / 80).epsilon(1e-9));
  }
}

TEST_CASE("explicit_contact: below Courant number 1 rigid rods that meet across a gap stay together too") {
  // Impedances 1 : 4, so that the thin rod comes back with -3/5 of its speed after 2L/c.
  const Bar rod = bars::steel_rod(0.5), thick = bars::steel_rod(1.5, FarEnd::free, 0.02);
  std::vector<double> errors;
  for (const std::size_t n : {40u, 80u, 160u, 320u}) {
    const double step = 0.5 * 0.5 / steel_speed / static_cast<double>(n);
    const ExplicitContactResult result = explicit_contact(bar_structure(rod, bar_mesh_by_count(rod, n)),
                                                          bar_structure(thick, bar_mesh_by_count(thick, 3 * n)),
                                                          {.speed_m_per_s = 1,
                                                           .step_s = step,
                                                           .duration_s = 4 * 0.5 / steel_speed,
                                                           .gap_m = 3e-6,
                                                           .after_contact = AfterContact::touch_again});
    CHECK(contact_intervals(result.trace, result.grid).size() == 1);
    errors.push_back(std::abs(result.projectile.momentum_Ns / mass_kg(rod.profile) + 0.6));
    CHECK(result.energy_error <= 0.15 / static_cast<double>(n));
  }
  CHECK(errors.back() <= 3e-3);
  CHECK(errors.back() <= 0.3 * errors.front());
}

TEST_CASE("explicit_contact: a rigid mass on a fixed rod, St Venant's forces and end of contact") {
  // Largest force over V Z, and the end in c t/L, for the rod's mass over the striking one.
  const double table[][3] = {{1, 2.1353, 3.0677}, {0.5, 2.3679, 4.7086}, {0.25, 2.9744, 5.8996}};
  const Bar rod = bars::steel_rod(0.5, FarEnd::fixed);
  const double z = face_impedance_kg_per_s(rod.profile, Face::a);
  for (const auto& [ratio, peak, end] : table) {
    std::vector<double> errors;
    for (const std::size_t n : {100u, 200u, 400u, 800u}) {
      const double step = 0.5 / steel_speed / static_cast<double>(n);
      const ExplicitContactResult result =
          explicit_contact(mass_structure(mass_kg(rod.profile) / ratio), bar_structure(rod, bar_mesh_by_count(rod, n)),
                           {.speed_m_per_s = 1, .step_s = step, .duration_s = 8 * static_cast<double>(n) * step});
      CHECK(result.trace.force_N[0] == about(z).epsilon(1e-12));
      // A front on a sample is the mean of both sides; the next sample has passed it.
      errors.push_back(std::abs(largest(result.trace.force_N) / z / peak - 1));
      CHECK(std::abs(result.contact_end_s * steel_speed / 0.5 / end - 1) <= 0.1 / static_cast<double>(n));
    }
    CHECK(errors.back() <= 2.5e-3);
    CHECK(order(errors) > 0.9);
  }
}

TEST_CASE("explicit_contact: a contact that cannot be computed is refused, with a way out") {
  const Structure cone = by_step(bars::cone(), 10e-6), rod = by_step(bars::long_rod(), 10e-6);
  const ExplicitContact good{.speed_m_per_s = 1, .step_s = 10e-6, .duration_s = 1e-3};
  const auto refused = [](const Structure& projectile, const Structure& target, const ExplicitContact& contact,
                          const char* message) {
    CHECK_THROWS_WITH_AS((void)explicit_contact(projectile, target, contact), message, std::invalid_argument);
  };
  ExplicitContact contact = good;
  contact.speed_m_per_s = 0;
  refused(cone, rod, contact, "speed 0 m/s is not positive");
  contact = good;
  contact.speed_2_m_per_s = 1.5;
  refused(cone, rod, contact, "the projectile's 1 m/s do not exceed the target's 1.5 m/s, so they never meet");
  contact = good;
  contact.gap_m = -1e-6;
  refused(cone, rod, contact, "gap -1e-06 m is negative");
  contact = good;
  contact.speed_2_m_per_s = -1;
  refused(cone, by_step(bars::steel_rod(6, FarEnd::fixed), 10e-6), contact,
          "the target is held (moving it without strain is not possible); a body with speed needs a free or infinite "
          "far end, or free edges");
  contact = good;
  contact.law = ContactLaw::table({.indentation_m = {0, 1e-6}, .loading_force_N = {0, 100}, .unloading_force_N = {}});
  refused(cone, rod, contact,
          "the contact is pressed to more than 1e-06 m, the last point of its law's table; extend the table");
  CHECK_THROWS_WITH_AS(
      (void)explicit_impact(
          cone, rod,
          {.speed_m_per_s = 1, .step_s = 10e-6, .duration_s = 1e-3, .after_contact = AfterContact::touch_again}),
      "an impact has one contact; explicit_contact lets bodies touch again", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)mass_structure(0), "mass 0 kg is not positive", std::invalid_argument);
}

TEST_CASE("explicit_contact: a record that stops after contact is the beginning of the one that goes on") {
  for (const ContactLaw& law : {ContactLaw::rigid(), ContactLaw::hertz(2e10)}) {
    const Structure cone = by_step(bars::cone(), 5e-6), rod = by_step(bars::long_rod(), 5e-6);
    ExplicitContact contact{.speed_m_per_s = 1, .step_s = 5e-6, .duration_s = 1.5e-3, .law = law};
    const ContactTrace whole = explicit_contact(cone, rod, contact).trace;
    contact.after_contact = AfterContact::stop;
    const ExplicitContactResult stopped = explicit_contact(cone, rod, contact);
    REQUIRE(stopped.grid.size < whole.force_N.size());
    CHECK(stopped.trace.in_contact.size() == stopped.grid.size);
    CHECK(std::equal(stopped.trace.force_N.begin(), stopped.trace.force_N.end(), whole.force_N.begin()));
    CHECK(std::equal(stopped.trace.work_2_J.begin(), stopped.trace.work_2_J.end(), whole.work_2_J.begin()));
    CHECK(contact_end_index(stopped.trace.force_N) + 3 == stopped.grid.size);
  }
}

}  // namespace
}  // namespace impulse
