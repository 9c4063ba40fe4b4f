#include "fem/explicit/explicit_impact.hpp"

#include "fem/bodies/bar_structure.hpp"
#include "fem/explicit/joined_bodies.hpp"
#include "fem/explicit/step_forces.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

namespace impulse {
namespace {

constexpr double rod_length_m = 0.5;
const double steel_speed = parse_material("steel").rod_wave_speed_m_per_s();

Structure meshed(const Bar& bar, std::size_t elements) { return bar_structure(bar, bar_mesh_by_count(bar, elements)); }
Structure by_step(const Bar& bar, double step_s) { return bar_structure(bar, bar_mesh_by_step(bar, step_s)); }

/// Its wave takes 100 us to the far end, which sends nothing back: the long rod of the published cases, cheaper.
Bar absorbing_rod() { return bars::steel_rod(steel_speed * 100e-6, FarEnd::infinite); }

ExplicitImpactResult tca(double step_s, std::size_t subcycles, Matching matching = Matching::direct,
                         ImpactStart start = ImpactStart::wave_admittance) {
  return explicit_impact(by_step(bars::cone(), step_s / static_cast<double>(subcycles)),
                         by_step(absorbing_rod(), step_s),
                         {.speed_m_per_s = 1.16,
                          .step_s = step_s,
                          .projectile_subcycles = subcycles,
                          .duration_s = 960e-6,
                          .matching = matching,
                          .start = start});
}

TEST_CASE("two equal rods push with V Z/2 for 2L/c exactly, whatever the start and the matching") {
  const Bar rod = bars::steel_rod(rod_length_m);
  const std::size_t n = 40;
  const double step = rod_length_m / steel_speed / static_cast<double>(n);
  const double force = 0.5 * face_impedance_kg_per_s(rod.profile, Face::a);
  const Structure projectile = meshed(rod, n), target = meshed(bars::steel_rod(3 * rod_length_m), 3 * n);
  for (const ImpactStart start : {ImpactStart::wave_admittance, ImpactStart::held})
    for (const Matching matching : {Matching::direct, Matching::bisection}) {
      const ExplicitImpactResult result = explicit_impact(
          projectile, target,
          {.speed_m_per_s = 1, .step_s = step, .duration_s = 300 * step, .matching = matching, .start = start});
      const double tolerance = (matching == Matching::direct ? 1e-13 : 1e-10) * force;
      double worst = 0;
      for (std::size_t k = 0; k < 2 * n; ++k) worst = std::max(worst, std::abs(result.history.force_N[k] - force));
      CHECK(worst <= tolerance);
      // The return falls on a sample: the mean of both sides, and nothing after it.
      CHECK(std::abs(result.history.force_N[2 * n] - 0.5 * force) <= 4 * tolerance);
      CHECK(result.history.force_N[2 * n + 1] == 0);
      CHECK(result.history.separated);
      CHECK(impulse_Ns(result.history) == about(mass_kg(rod.profile)).epsilon(1e-9));
    }
}

TEST_CASE("the projectile stops dead on a longer rod of its section, and the restitution is the ratio of lengths") {
  const Bar rod = bars::steel_rod(rod_length_m);
  const double step = rod_length_m / steel_speed / 50;
  const ExplicitImpactResult result = explicit_impact(meshed(rod, 50), meshed(bars::steel_rod(2 * rod_length_m), 100),
                                                      {.speed_m_per_s = 2, .step_s = step, .duration_s = 150 * step});
  const double mass = mass_kg(rod.profile);
  CHECK(std::abs(result.projectile.momentum_Ns) <= 1e-13 * 2 * mass);
  CHECK(result.target.momentum_Ns / (2 * mass) == about(1.0).epsilon(1e-12));
  const double restitution = (result.target.momentum_Ns / 2 - result.projectile.momentum_Ns) / (2 * mass);
  CHECK(restitution == about(0.5).epsilon(1e-12));
  CHECK(result.projectile.kinetic_energy_J + result.projectile.strain_energy_J <= 1e-13 * mass);
}

TEST_CASE("rods of different impedance: F = V Z1 Z2/(Z1+Z2), the impulse of a jump at release with order 1") {
  const Bar rod = bars::steel_rod(rod_length_m), thick = bars::steel_rod(2 * rod_length_m, FarEnd::free, 0.020);
  const double z = face_impedance_kg_per_s(rod.profile, Face::a), force = z * 4 * z / (5 * z);
  std::vector<double> errors;
  for (const std::size_t n : {10u, 20u, 40u, 80u}) {
    const double step = rod_length_m / steel_speed / static_cast<double>(n);
    const ExplicitImpactResult result =
        explicit_impact(meshed(rod, n), meshed(thick, 2 * n),
                        {.speed_m_per_s = 1, .step_s = step, .duration_s = 3 * static_cast<double>(n) * step});
    for (std::size_t k = 0; k < 2 * n; ++k) REQUIRE(std::abs(result.history.force_N[k] - force) <= 1e-13 * force);
    errors.push_back(std::abs(impulse_Ns(result.history) / (force * 2 * rod_length_m / steel_speed) - 1));
  }
  for (std::size_t i = 1; i < errors.size(); ++i) CHECK(std::abs(std::log2(errors[i - 1] / errors[i]) - 1) <= 0.1);
}

TEST_CASE("case TCA tends to the exact force and impulse; the impulse with order 2") {
  // Exact one-dimensional values at 118, 355, 545 and 782 us, three independent methods agreeing to 1e-10 N.
  const double exact[] = {1516.266007, 2216.869017, 1047.522209, 672.485290};
  const std::size_t time_us[] = {118, 355, 545, 782};
  std::vector<double> impulse_errors, before_jump;
  for (const std::size_t per_us : {1u, 2u, 4u, 8u}) {
    const ExplicitImpactResult result = tca(1e-6 / static_cast<double>(per_us), 1);
    impulse_errors.push_back(std::abs(impulse_Ns(result.history) - 1.287913769));
    before_jump.push_back(0);
    for (int i = 0; i < 4; ++i) {
      const double error = std::abs(result.history.force_N[time_us[i] * per_us] - exact[i]);
      // Behind the front of 512.7 us a wake of the shortest waves trails, which decays with time and step.
      const double bound[] = {0.1, 0.02, 6, 0.5};
      CHECK(error <= bound[i] / std::sqrt(static_cast<double>(per_us)));
      if (i < 2) before_jump.back() = std::max(before_jump.back(), error);
    }
    CHECK(std::abs(result.history.contact_end_s - 947.851935e-6) <= 0.03e-6);
  }
  for (std::size_t i = 1; i < impulse_errors.size(); ++i) CHECK(impulse_errors[i] < impulse_errors[i - 1]);
  CHECK(std::abs(std::log2(impulse_errors.front() / impulse_errors.back()) / 3 - 2) <= 0.1);
  CHECK(before_jump.back() <= 2.5e-3);
}

TEST_CASE("direct matching and bisection agree to 1e-9 of the peak") {
  for (const std::size_t subcycles : {1u, 4u})
    for (const ImpactStart start : {ImpactStart::wave_admittance, ImpactStart::held, ImpactStart::zero}) {
      const ImpactHistory one = tca(10e-6, subcycles, Matching::direct, start).history;
      const ImpactHistory two = tca(10e-6, subcycles, Matching::bisection, start).history;
      double peak = 0, worst = 0;
      for (std::size_t k = 0; k < one.grid.size; ++k) {
        peak = std::max(peak, one.force_N[k]);
        worst = std::max(worst, std::abs(one.force_N[k] - two.force_N[k]));
      }
      CHECK(worst <= 1e-9 * peak);
      CHECK(one.contact_end_s == about(two.contact_end_s).epsilon(1e-8));
    }
}

TEST_CASE("bodies kept together for 30 ms stay calm with any number of subcycles") {
  for (const std::size_t subcycles : {1u, 2u, 4u, 7u})
    for (const bool courant_1 : {false, true}) {
      const double step = 10e-6;
      const Bar rod = courant_1 ? bars::steel_rod(steel_speed * 1000e-6) : bars::long_rod();
      const Structure projectile = by_step(bars::cone(), step / static_cast<double>(subcycles));
      const Structure target = by_step(rod, step);
      const std::vector<ExplicitBody> both{{projectile, 1.16, subcycles}, {target, 0, 1}};
      JoinedBodies bodies(both, step);
      double force = 1.16 / (projectile.wave_admittance(0, 0) + target.wave_admittance(0, 0));
      bodies.set_forces(Eigen::VectorXd::Constant(1, force));
      const std::vector<std::optional<LawContact>> rigid(1);
      double first_third = 0, last_third = 0;
      for (int n = 0; n < 3000; ++n) {
        bodies.integrate({{force, force}});
        const StepForces more =
            step_forces(bodies, {bodies.closing_speed(), Eigen::VectorXd::Zero(1)}, {0}, StepForce::ramp, rigid);
        apply(bodies, more, StepForce::ramp, rigid);
        force += more.force_N[0];
        if (n < 1000) first_third = std::max(first_third, std::abs(force));
        if (n >= 2000) last_third = std::max(last_third, std::abs(force));
      }
      CHECK(last_third <= 1.25 * first_third);
    }
}

TEST_CASE("below Courant number 1 velocities are blind to a force (-1)^n: the default start leaves none of it") {
  // Without subcycles v = (d_{n+1} - d_{n-1})/(2Δt) vanishes for it, so that what a start misses of
  // F₀ = V/(½Δt Σ cᵀM⁻¹c) rings on.
  const Bar rod = bars::steel_rod(rod_length_m, FarEnd::infinite);
  const auto zigzag = [&](ImpactStart start, double courant, std::size_t subcycles) {
    const double step = courant * rod_length_m / steel_speed / 20;
    const Structure target = meshed(rod, 20), projectile = meshed(rod, 20 * subcycles);
    const ImpactHistory history = explicit_impact(projectile, target,
                                                  {.speed_m_per_s = 1,
                                                   .step_s = step,
                                                   .projectile_subcycles = subcycles,
                                                   .duration_s = 400 * step,
                                                   .start = start})
                                      .history;
    double worst = 0;
    for (std::size_t k = 300; k + 1 < history.grid.size; ++k)
      worst = std::max(worst, std::abs(history.force_N[k + 1] - history.force_N[k]));
    return worst / (0.5 * face_impedance_kg_per_s(rod.profile, Face::a));
  };
  CHECK(zigzag(ImpactStart::zero, 0.9, 1) > 0.9);
  CHECK(zigzag(ImpactStart::held, 0.9, 1) < 0.2);
  // What is left is the ringing of the lattice's shortest waves, which dies away.
  for (const double courant : {1.0, 0.9, 0.5, 0.2}) {
    CAPTURE(courant);
    CHECK(zigzag(ImpactStart::wave_admittance, courant, 1) < 0.008);
  }
  // With subcycles it dies away if the projectile's mesh takes up a wave of two steps of the row, sin(π/2m) < C;
  // else its face answers as a mass, and part of the zigzag stays.
  CHECK(zigzag(ImpactStart::wave_admittance, 0.9, 2) < 0.008);
  CHECK(zigzag(ImpactStart::wave_admittance, 1, 5) < 0.008);
  CHECK(zigzag(ImpactStart::wave_admittance, 0.5, 2) > 0.1);
}

TEST_CASE("the work is one trial per step directly, and at most sixty by bisection") {
  const ExplicitImpactResult direct = tca(10e-6, 4);
  const std::size_t steps = direct.history.grid.size - 1;
  CHECK(direct.trial_count <= steps);
  CHECK(direct.target.step_count <= steps + 3);
  CHECK(direct.projectile.step_count == 4 * direct.target.step_count);
  CHECK(tca(10e-6, 4, Matching::bisection).trial_count <= 60 * direct.trial_count);
}

TEST_CASE("an impact that cannot be computed is refused, with a way out") {
  const Structure cone = by_step(bars::cone(), 10e-6), rod = by_step(bars::long_rod(), 10e-6);
  const ExplicitImpact good{.speed_m_per_s = 1, .step_s = 10e-6, .duration_s = 1e-4};
  const auto refused = [&](const Structure& projectile, const Structure& target, ExplicitImpact impact,
                           const char* message) {
    CHECK_THROWS_WITH_AS((void)explicit_impact(projectile, target, impact), message, std::invalid_argument);
  };
  ExplicitImpact impact = good;
  impact.speed_m_per_s = -1;
  refused(cone, rod, impact, "speed -1 m/s is not positive");
  impact = good;
  impact.projectile_subcycles = 0;
  refused(cone, rod, impact, "0 subcycles of the projectile (it takes at least one step); use 1 or more");
  impact = good;
  impact.step_s = 11e-6;
  refused(cone, rod, impact, "step 11 us exceeds the stability limit 10.04 us of the target; use --step 10us");
  refused(by_step(bars::cone(), 3e-6), rod, good,
          "projectile step 10 us (10 us in 1) exceeds its stability limit 3.016 us; use --subcycles 4");
  impact = good;
  impact.duration_s = 1e-6;
  CHECK_THROWS_WITH_AS((void)explicit_impact(cone, rod, impact), doctest::Contains("shorter than one step"),
                       std::invalid_argument);
  const Bar both_faces{bars::cone().profile, {Face::a, Face::b}, FarEnd::free};
  refused(by_step(both_faces, 10e-6), rod, good,
          "the projectile has 2 contacts; explicit_contact takes one, explicit_contacts more");
  const Bar held{bars::cone().profile, {Face::a}, FarEnd::fixed};
  refused(by_step(held, 10e-6), rod, good,
          "the projectile is held (moving it without strain is not possible); a body with speed needs a free or "
          "infinite far end, or free edges");
}

}  // namespace
}  // namespace impulse
