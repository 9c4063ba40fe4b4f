// The cone of nylon that strikes the steel rod with its large end, in two dimensions: what 1-D theory cannot tell.
#include "fem/bodies/axisymmetric_solid.hpp"
#include "fem/explicit/explicit_impact.hpp"
#include "fem/implicit/step_response.hpp"
#include "fem/mesh/solid_mesh.hpp"
#include "impulse/contact/contact_equation.hpp"
#include "impulse/response/displacement_response.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/wave_response.hpp"
#include "lib/model/modal_model.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace impulse {
namespace {

constexpr double speed = 0.93, radius = 5e-3, duration = 1.2e-3;
const Bar rod{{parse_segment("3.2m,10mm,steel")}, {Face::a}, FarEnd::free};

struct Discretisation {
  CircleContact contact = CircleContact::punch;
  double size_per_radius = 0.05;
  SolidMeshOptions mesh = {};
  double step_s = 1e-6;
  std::size_t substeps = 2;
  std::size_t modes = 0;  // 0: by steps
};

Structure cone(const Discretisation& d, MassMatrix mass = MassMatrix::consistent) {
  const Profile profile{parse_segment("400mm,30mm,75mm,nylon-6:0.40")};
  return axisymmetric_structure({.mesh = solid_mesh(profile, {{Face::b, radius, d.size_per_radius * radius}}, d.mesh),
                                 .materials = {isotropic_elasticity(profile[0].material)},
                                 .contacts = {{Face::b, radius, d.contact}},
                                 .mass = mass})
      .structure;
}

/// What is compared of a force.
struct Blow {
  double peak_N = 0;
  double impulse = 0;
  double rise_s = 0;  // first time at half the peak
  double fall_s = 0;  // last time there
  double end_s = 0;
};

Blow blow_of(const ImpactHistory& history) {
  const std::vector<double>& f = history.force_N;
  Blow blow{*std::ranges::max_element(f), impulse_Ns(history), 0, 0, history.contact_end_s};
  const double half = blow.peak_N / 2;
  const auto crossing = [&](std::size_t n) {
    return history.grid.step_s * (double(n) - 1 + (half - f[n - 1]) / (f[n] - f[n - 1]));
  };
  std::size_t first = 1, last = f.size() - 1;
  while (f[first] < half) ++first;
  while (f[last - 1] < half) --last;
  blow.rise_s = crossing(first);
  blow.fall_s = crossing(last);
  return blow;
}

Blow predicted(const Discretisation& d) {
  const UniformGrid grid = grid_over(duration, d.step_s);
  const Structure body = cone(d);
  const Response response =
      d.modes > 0
          ? modal_response(modal_model(body, {.mode_count = d.modes, .residual = ModalOptions::Residual::attached}),
                           grid)
          : displacement_response(grid, step_displacements(body, grid, {.substeps = d.substeps, .observer = {}}),
                                  body.wave_admittance);
  return blow_of(solve_contact(response, wave_response(rod, grid), {speed}, ContactMethod::product));
}

void check_close(const Blow& a, const Blow& b, double relative, double time_s) {
  CHECK(a.peak_N == about(b.peak_N).epsilon(relative));
  CHECK(a.impulse == about(b.impulse).epsilon(relative));
  CHECK(std::abs(a.rise_s - b.rise_s) < time_s);
  CHECK(std::abs(a.fall_s - b.fall_s) < time_s);
  CHECK(std::abs(a.end_s - b.end_s) < time_s);
}

TEST_CASE("TCB: the thesis' meshes of 616 and 1305 elements are within 1 % of the converged force") {
  const Blow converged = predicted({.size_per_radius = 0.025, .mesh = {1.2, 0.15}});
  const Blow coarse = predicted({.size_per_radius = 0.5, .mesh = {1.08, 0.32}});
  const Blow fine = predicted({.size_per_radius = 0.2, .mesh = {1.1, 0.21}});
  // The punch's missing flexibility, 0.09 h/a: 4.5 % and 1.8 % of the local one, which is a part of all.
  CHECK(coarse.peak_N == about(converged.peak_N).epsilon(0.012));
  CHECK(fine.peak_N == about(converged.peak_N).epsilon(0.006));
  CHECK(coarse.impulse == about(converged.impulse).epsilon(0.003));
  CHECK(fine.impulse == about(converged.impulse).epsilon(0.001));
}

TEST_CASE("TCB: rod theory in series with the local flexibility of the half-space comes within 2 % of the impulse") {
  // The cone's face is 7.5 times the circle: the local flexibility (1-ν²)/(2Ea)(1-1.41 a/b) in series with plane waves.
  const UniformGrid grid = grid_over(duration, 1e-6);
  const Bar bar{{parse_segment("400mm,30mm,75mm,nylon-6")}, {Face::b}, FarEnd::free};
  Response response = wave_response(bar, grid);
  const double local = (1 - 0.4 * 0.4) / (2 * 2.8e9 * radius) * (1 - 1.41 * radius / 37.5e-3);
  for (double& u : response.pair(0, 0).step_displacement_m_per_N) u += local;
  const Blow ours = predicted({}),
             simple = blow_of(solve_contact(response, wave_response(rod, grid), {speed}, ContactMethod::product));
  CHECK(simple.impulse == about(ours.impulse).epsilon(0.02));
  CHECK(simple.peak_N == about(ours.peak_N).epsilon(0.02));
}

TEST_SUITE_BEGIN("slow");

TEST_CASE("TCB in two dimensions: mesh and modes and step are converged to 0.5 % and 5 us") {
  for (const CircleContact contact : {CircleContact::punch, CircleContact::pressure}) {
    const Blow base = predicted({.contact = contact});
    check_close(predicted({.contact = contact, .size_per_radius = 0.025, .mesh = {1.2, 0.15}}), base, 0.005, 5e-6);
    check_close(predicted({.contact = contact, .step_s = 2e-6, .substeps = 4}), base, 0.005, 5e-6);
    check_close(predicted({.contact = contact, .substeps = 6}), base, 0.005, 5e-6);
    check_close(predicted({.contact = contact, .modes = 200}), base, 0.005, 5e-6);
    check_close(predicted({.contact = contact, .modes = 60}), base, 0.005, 5e-6);
  }
}

TEST_CASE("TCB: explicit finite elements that share no integration with the responses agree within 2 % and 5 us") {
  // Peaks differ by the ringing of lumped triangles; impulses agree to 0.1 %.
  for (const CircleContact contact : {CircleContact::punch, CircleContact::pressure}) {
    const Discretisation coarse{.contact = contact, .size_per_radius = 0.1, .mesh = {1.2, 0.15}};
    ExplicitImpact impact;
    impact.speed_m_per_s = speed;
    impact.step_s = 0.4e-6;  // waves cross the rod's elements in one step, the cone takes ten in it
    impact.projectile_subcycles = 10;
    impact.duration_s = duration;
    const Structure target = bar_structure(rod, bar_mesh_by_step(rod, impact.step_s));
    const ExplicitImpactResult witness = explicit_impact(cone(coarse, MassMatrix::lumped), target, impact);
    const Blow blow = blow_of(witness.history), ours = predicted({.contact = contact});
    check_close(blow, ours, 0.02, 5e-6);
    CHECK(blow.impulse == about(ours.impulse).epsilon(1e-3));
  }
}

TEST_SUITE_END();

}  // namespace
}  // namespace impulse
