#include "fem/bodies/bar_structure.hpp"
#include "fem/explicit/explicit_impact.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

#include <cmath>

/// What must hold whatever the mesh: momentum, energy, agreement of the faces, and freedom after release.
namespace impulse {
namespace {

Structure by_step(const Bar& bar, double step_s) { return bar_structure(bar, bar_mesh_by_step(bar, step_s)); }

ExplicitImpactResult struck_rod(const Bar& projectile, double step_s, std::size_t subcycles, double duration_s,
                                AfterContact after = AfterContact::go_on) {
  return explicit_impact(by_step(projectile, step_s / static_cast<double>(subcycles)),
                         by_step(bars::long_rod(), step_s),
                         {.speed_m_per_s = 1.1,
                          .step_s = step_s,
                          .projectile_subcycles = subcycles,
                          .duration_s = duration_s,
                          .after_contact = after});
}

TEST_CASE("each body's momentum is the impulse of the force in the record, subcycles included, released or not") {
  for (const Bar& projectile : {bars::cone(Face::a), bars::cone(Face::b), bars::composite(Face::b)})
    for (const std::size_t subcycles : {1u, 2u, 4u, 7u})
      for (const double duration_s : {300e-6, 1.3e-3}) {
        const ExplicitImpactResult result = struck_rod(projectile, 17e-6, subcycles, duration_s);
        CHECK(result.history.separated == (duration_s > 1e-3));
        const double arrived = 1.1 * mass_kg(projectile.profile), impulse = impulse_Ns(result.history);
        CHECK(std::abs(result.projectile.momentum_Ns - (arrived - impulse)) <= 1e-12 * arrived);
        CHECK(std::abs(result.target.momentum_Ns - impulse) <= 1e-12 * arrived);
      }
}

TEST_CASE("in contact the face velocities agree at every sample, and after it the force is zero") {
  const ImpactHistory history = struck_rod(bars::composite(), 10e-6, 3, 1.2e-3).history;
  REQUIRE(history.separated);
  for (std::size_t k = 0; k < history.grid.size; ++k) {
    if (history.grid.time_s(k) < history.contact_end_s)
      CHECK(std::abs(history.velocity_1_m_per_s[k] - history.velocity_2_m_per_s[k]) <= 1e-12);
    else
      CHECK(history.force_N[k] == 0);
  }
  // Tension would have kept the faces together; released, they part.
  CHECK(history.velocity_2_m_per_s.back() > history.velocity_1_m_per_s.back() + 0.01);
}

TEST_CASE("the energies of both bodies are those that arrived, to order 1 in the step") {
  // The jump at first touch costs F₀ V Δt/4 of V ∫F dt.
  const Bar rod = bars::steel_rod(0.5);
  std::vector<double> errors;
  for (const std::size_t n : {10u, 20u, 40u, 80u}) {
    const double step = travel_time_s(rod.profile) / static_cast<double>(n);
    const Structure projectile = bar_structure(rod, {{n}, MassMatrix::lumped});
    const Bar longer = bars::steel_rod(1.0);
    const ExplicitImpactResult result =
        explicit_impact(projectile, bar_structure(longer, {{2 * n}, MassMatrix::lumped}),
                        {.speed_m_per_s = 1, .step_s = step, .duration_s = 2.5 * travel_time_s(rod.profile)});
    errors.push_back(result.history.energy_error);
    CHECK(errors.back() == about(1 / (8.0 * static_cast<double>(n))).epsilon(1e-9));
    const double arrived = 0.5 * mass_kg(rod.profile);
    const double left = result.projectile.kinetic_energy_J + result.projectile.strain_energy_J +
                        result.target.kinetic_energy_J + result.target.strain_energy_J;
    CHECK(std::abs(left / arrived - 1) <= 0.26 / static_cast<double>(n));
  }
}

TEST_CASE("the energy error of a cone on a rod is that of the first jump, and small with subcycles too") {
  for (const double step_us : {4.0, 2.0, 1.0}) {
    const ExplicitImpactResult result = struck_rod(bars::cone(), step_us * 1e-6, 1, 1e-3);
    const double jump = result.history.force_N[0] * step_us * 1e-6 / (4 * impulse_Ns(result.history));
    CHECK(result.history.energy_error == about(jump).epsilon(0.15));
    CHECK(struck_rod(bars::cone(), step_us * 1e-6, 4, 1e-3).history.energy_error <= 2e-3 * step_us);
  }
}

TEST_CASE(
    "an infinite target takes the work into its dashpot, and an infinite projectile pushes on with V Z1 Z2/(Z1+Z2)") {
  const Bar rod = bars::steel_rod(0.5);
  const double step = travel_time_s(rod.profile) / 40, z = face_impedance_kg_per_s(rod.profile, Face::a);
  const Structure endless = by_step(bars::steel_rod(0.5, FarEnd::infinite), step);
  const ExplicitImpact impact{.speed_m_per_s = 2, .step_s = step, .duration_s = 200 * step};
  const ExplicitImpactResult absorbed = explicit_impact(by_step(rod, step), endless, impact);
  // All that the projectile had, but for half a step at the front and the release.
  CHECK(absorbed.target.dissipated_J == about(0.5 * mass_kg(rod.profile) * 4).epsilon(0.02));
  CHECK(absorbed.target.kinetic_energy_J + absorbed.target.strain_energy_J <= 1e-12);
  const ExplicitImpactResult pushed = explicit_impact(endless, endless, impact);
  CHECK_FALSE(pushed.history.separated);
  CHECK(pushed.history.contact_end_s == pushed.history.grid.duration_s());
  for (const double force : pushed.history.force_N) REQUIRE(std::abs(force - z) <= 1e-12 * z);
  for (const double velocity : pushed.history.velocity_1_m_per_s) REQUIRE(std::abs(velocity - 1) <= 1e-12);
}

TEST_CASE("the force is proportional to the speed and does not depend on the side from which the bodies are drawn") {
  const Bar cone = bars::cone(), mirror{reversed(cone.profile), {Face::b}, FarEnd::free};
  const Structure rod = by_step(bars::long_rod(), 10e-6);
  ExplicitImpact impact{.speed_m_per_s = 1, .step_s = 10e-6, .duration_s = 1e-3};
  const ExplicitImpactResult one = explicit_impact(by_step(cone, 10e-6), rod, impact);
  impact.speed_m_per_s = 3;
  const ExplicitImpactResult three = explicit_impact(by_step(mirror, 10e-6), rod, impact);
  for (std::size_t k = 0; k < one.history.grid.size; ++k) {
    CHECK(std::abs(three.history.force_N[k] - 3 * one.history.force_N[k]) <= 1e-8);
    CHECK(std::abs(three.history.velocity_1_m_per_s[k] - 3 * one.history.velocity_1_m_per_s[k]) <= 1e-11);
  }
  CHECK(three.projectile.momentum_Ns == about(3 * one.projectile.momentum_Ns).epsilon(1e-11));
}

TEST_CASE("a record stopped after contact is the beginning of the one that goes on") {
  const ImpactHistory whole = struck_rod(bars::cone(), 10e-6, 2, 1.5e-3).history;
  const ImpactHistory stopped = struck_rod(bars::cone(), 10e-6, 2, 1.5e-3, AfterContact::stop).history;
  REQUIRE(stopped.separated);
  CHECK(stopped.grid.size == contact_end_index(stopped.force_N) + 3);
  for (std::size_t k = 0; k < stopped.grid.size; ++k) {
    CHECK(stopped.force_N[k] == whole.force_N[k]);
    CHECK(stopped.velocity_1_m_per_s[k] == whole.velocity_1_m_per_s[k]);
  }
  CHECK(stopped.contact_end_s == whole.contact_end_s);
  CHECK(stopped.energy_error == whole.energy_error);
}

}  // namespace
}  // namespace impulse
