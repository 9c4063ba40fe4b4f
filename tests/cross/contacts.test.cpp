// Contacts that open and close, with laws, in rows and at several points: the marched contact equation on travelling
// waves and exact modes against explicit elements.
#include "fem/bodies/bar_structure.hpp"
#include "fem/bodies/beam_structure.hpp"
#include "fem/bodies/mass_structure.hpp"
#include "fem/bodies/modal_structure.hpp"
#include "fem/explicit/explicit_contacts.hpp"
#include "impulse/contact/contacts_problem.hpp"
#include "impulse/exact/beam_modes.hpp"
#include "impulse/response/mass_response.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/wave_response.hpp"
#include "lib/series/series_comparison.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace impulse;

namespace {

Structure by_step(const Bar& bar, double step_s) { return bar_structure(bar, bar_mesh_by_step(bar, step_s)); }

Bar struck_at(Bar bar, const std::vector<Face>& faces) {
  bar.faces = faces;
  return bar;
}

double l2(const UniformGrid& grid, const std::vector<double>& reference, const std::vector<double>& other) {
  return series_difference({grid, reference}, {grid, other}, {grid.duration_s(), {}, 0}).relative_l2;
}

std::vector<ContactInterval> tcb_by_waves(double step) {
  const UniformGrid grid = grid_over(1.2e-3, step);
  ContactsProblem problem;
  problem.speed_m_per_s = {0.93, 0};
  problem.laws = {ContactLaw::rigid()};
  problem.gaps_m = {0};
  problem.recontact = Recontact::yes;
  const ContactsSolution solution =
      solve_contacts({wave_response(bars::cone(Face::b), grid), wave_response(bars::long_rod(), grid)}, problem);
  return contact_intervals(solution.traces[0], grid);
}

std::vector<ContactInterval> tcb_by_elements(double step) {
  const ExplicitContactsResult result =
      explicit_contacts({{by_step(bars::cone(Face::b), step), 0.93}, {by_step(bars::long_rod(), step)}},
                        {.step_s = step,
                         .duration_s = 1.2e-3,
                         .laws = {ContactLaw::rigid()},
                         .gaps_m = {0},
                         .after_contact = AfterContact::touch_again});
  return contact_intervals(result.traces[0], result.grid);
}

}  // namespace

TEST_CASE("cross: the cone of case TCB touches the rod again, by waves and by elements") {
  // Rod theory: contact from 0 to 512.7 us, 0.8246 N s, and from 597 to 1025 us with 407 N and 0.1369 N s.
  std::vector<double> impulses_apart;
  for (const double step_us : {2.0, 1.0, 0.5, 0.25}) {
    CAPTURE(step_us);
    const std::vector<ContactInterval> waves = tcb_by_waves(step_us * 1e-6), elements = tcb_by_elements(step_us * 1e-6);
    REQUIRE(waves.size() == 2);
    REQUIRE(elements.size() == 2);
    impulses_apart.push_back(std::abs(waves[0].impulse_Ns - elements[0].impulse_Ns) +
                             std::abs(waves[1].impulse_Ns - elements[1].impulse_Ns));
    for (const std::vector<ContactInterval>& found : {waves, elements}) {
      // A contact that opens or closes between samples is found within a sample or two; the elements' release leaves
      // a trembling from step to step, which adds to the peak.
      CHECK(std::abs(found[0].end_s - 512.7e-6) <= 1.1e-6 * step_us);
      CHECK(std::abs(found[1].start_s - 597.0e-6) <= 2.1e-6 * step_us);
      CHECK(std::abs(found[1].end_s - 1025.2e-6) <= 1.5e-6 * step_us);
      CHECK(found[0].impulse_Ns == about(0.8246).epsilon(1e-3 * step_us));
      CHECK(found[1].impulse_Ns == about(0.1369).epsilon(5e-3 * step_us));
      CHECK(found[1].peak_force_N == about(407).epsilon(0.005 + 0.008 * step_us));
    }
  }
  CHECK(impulses_apart.back() <= 0.5 * impulses_apart.front());
  CHECK(impulses_apart.back() <= 5e-5);
}

TEST_CASE("cross: a row of three bodies with laws and gaps, by waves and by elements, apart by less the finer both") {
  const Bar first = struck_at(bars::steel_rod(0.3, FarEnd::free, 0.02), {Face::b});
  const Bar inner = struck_at(
      {{parse_segment("60mm,30mm,steel"), parse_segment("40mm,20mm,aluminium")}, {}, FarEnd::free}, {Face::a, Face::b});
  const Bar last = bars::steel_rod(1.0, FarEnd::free, 0.02);
  for (const AfterContact after : {AfterContact::go_on, AfterContact::touch_again}) {
    std::vector<double> apart_1, apart_2;
    for (const double step : {1e-6, 0.5e-6, 0.25e-6, 0.125e-6}) {
      const UniformGrid grid = grid_over(4e-4, step);
      ContactsProblem problem;
      problem.speed_m_per_s = {2, 0, 0};
      problem.laws = {ContactLaw::hertz(1e10), ContactLaw::tan_sun(2e10, 0.1, 1e-6)};
      problem.gaps_m = {0, 10e-6};
      problem.recontact = after == AfterContact::go_on ? Recontact::no : Recontact::yes;
      const ContactsSolution waves =
          solve_contacts({wave_response(first, grid), wave_response(inner, grid), wave_response(last, grid)}, problem);
      const ExplicitContactsResult elements = explicit_contacts(
          {{by_step(first, step), 2}, {by_step(inner, step)}, {by_step(last, step)}},
          {.step_s = step, .duration_s = 4e-4, .laws = problem.laws, .gaps_m = problem.gaps_m, .after_contact = after});
      apart_1.push_back(l2(grid, waves.traces[0].force_N, elements.traces[0].force_N));
      apart_2.push_back(l2(grid, waves.traces[1].force_N, elements.traces[1].force_N));
    }
    for (const std::vector<double>& apart : {apart_1, apart_2}) {
      CHECK(apart.back() <= 1e-5);
      CHECK(apart.back() <= 0.25 * apart.front());
    }
  }
}

TEST_CASE("cross: two beams meet at two points, one later than the other, by exact modes and by elements") {
  const Material steel = parse_material("steel");
  const Beam upper{0.3, 0.02, 0.010, steel, BeamSupports::free, {0.3, 0.8}};
  const Beam lower{0.4, 0.02, 0.015, steel, BeamSupports::simple, {0.35, 0.7}};
  std::vector<double> apart_1, apart_2;
  for (const double step : {8e-6, 4e-6, 2e-6, 1e-6}) {
    const UniformGrid grid = grid_over(2e-3, step);
    ContactsProblem problem;
    problem.speed_m_per_s = {1, 0};
    problem.laws = {ContactLaw::linear(1e6), ContactLaw::linear(2e6)};
    problem.gaps_m = {0, 100e-6};
    problem.recontact = Recontact::yes;
    const ModeRange range{.highest_frequency_Hz = 0.5 / 0.5e-6};
    const ContactsSolution modes = solve_contacts(
        {modal_response(exact_beam_modes(upper, range), grid), modal_response(exact_beam_modes(lower, range), grid)},
        problem);
    const ExplicitContactsResult elements =
        explicit_contacts({{beam_structure(upper, {}, beam_mesh_by_step(upper, {}, step)), 1},
                           {beam_structure(lower, {}, beam_mesh_by_step(lower, {}, step))}},
                          {.step_s = step,
                           .duration_s = 2e-3,
                           .laws = problem.laws,
                           .gaps_m = problem.gaps_m,
                           .after_contact = AfterContact::touch_again});
    apart_1.push_back(l2(grid, modes.traces[0].force_N, elements.traces[0].force_N));
    apart_2.push_back(l2(grid, modes.traces[1].force_N, elements.traces[1].force_N));
    const auto periods = [&](const ContactTrace& trace) { return contact_intervals(trace, grid).size(); };
    CHECK(periods(elements.traces[0]) == periods(modes.traces[0]));
    CHECK(periods(elements.traces[1]) == periods(modes.traces[1]));
  }
  CHECK(apart_1.back() <= 0.25 * apart_1.front());
  CHECK(apart_2.back() <= 0.25 * apart_2.front());
}

TEST_CASE("cross: a body by its modes with residual flexibility, marched and in explicit steps, apart with order 2") {
  const ModalModel all = modal_model(bar_structure(bars::steel_rod(0.5, FarEnd::fixed), {{60}, MassMatrix::lumped}));
  for (const ContactLaw& law : {ContactLaw::hertz(5e9), ContactLaw::rigid()}) {
    std::vector<double> apart;
    // The slowest ten modes, whatever the step.
    const Structure few = modal_structure(all, 0.999 / all.angular_frequency[9]);
    ModalModel same = all;
    same.angular_frequency.conservativeResize(10);
    same.damping_ratio.conservativeResize(10);
    same.participation.conservativeResize(10, 1);
    same.residual_flexibility = few.residual_flexibility;
    REQUIRE(few.mass.rows() == 10);
    REQUIRE(few.residual_flexibility(0, 0) > 0);
    for (const double step : {1e-6, 0.5e-6, 0.25e-6, 0.125e-6}) {
      const UniformGrid grid = grid_over(8e-4, step);
      ContactsProblem problem;
      problem.speed_m_per_s = {1, 0};
      problem.laws = {law};
      problem.gaps_m = {0};
      const ContactsSolution marched = solve_contacts({mass_response(0.2, grid), modal_response(same, grid)}, problem);
      const ExplicitContactsResult explicitly = explicit_contacts(
          {{mass_structure(0.2), 1}, {few}}, {.step_s = step, .duration_s = 8e-4, .laws = {law}, .gaps_m = {0}});
      apart.push_back(l2(grid, marched.traces[0].force_N, explicitly.traces[0].force_N));
    }
    CHECK(std::abs(std::log2(apart.front() / apart.back()) / 3 - 2) <= 0.1);
  }
}

TEST_CASE(
    "cross: two points on a body of a few modes, whose residual flexibility acts across them, apart with order 2") {
  const Material steel = parse_material("steel");
  const Beam upper{0.3, 0.02, 0.010, steel, BeamSupports::free, {0.3, 0.8}};
  const Beam lower{0.4, 0.02, 0.015, steel, BeamSupports::simple, {0.35, 0.7}};
  const Structure arriving = beam_structure(upper, {}, beam_mesh_by_count(upper, {}, 8, MassMatrix::lumped));
  const ModalModel all = modal_model(beam_structure(lower, {}, beam_mesh_by_count(lower, {}, 20, MassMatrix::lumped)));
  const Structure few = modal_structure(all, 0.999 / all.angular_frequency[2]);
  const Eigen::Index kept = few.mass.rows();
  REQUIRE(std::abs(few.residual_flexibility(0, 1)) > 0.1 * few.residual_flexibility(0, 0));
  ModalModel same = all;
  same.angular_frequency.conservativeResize(kept);
  same.damping_ratio.conservativeResize(kept);
  same.participation.conservativeResize(kept, 2);
  same.residual_flexibility = few.residual_flexibility;
  std::vector<double> apart_1, apart_2;
  for (const double step : {4e-6, 2e-6, 1e-6, 0.5e-6}) {
    const UniformGrid grid = grid_over(6e-4, step);
    ContactsProblem problem;
    problem.speed_m_per_s = {1, 0};
    problem.laws = {ContactLaw::linear(4e6), ContactLaw::hertz(5e8)};
    problem.gaps_m = {0, 0};
    const ContactsSolution marched =
        solve_contacts({modal_response(modal_model(arriving), grid), modal_response(same, grid)}, problem);
    const ExplicitContactsResult explicitly = explicit_contacts(
        {{arriving, 1}, {few}}, {.step_s = step, .duration_s = 6e-4, .laws = problem.laws, .gaps_m = problem.gaps_m});
    apart_1.push_back(l2(grid, marched.traces[0].force_N, explicitly.traces[0].force_N));
    apart_2.push_back(l2(grid, marched.traces[1].force_N, explicitly.traces[1].force_N));
  }
  for (const std::vector<double>& apart : {apart_1, apart_2}) {
    CHECK(apart.back() < 1e-6);
    CHECK(std::abs(std::log2(apart.front() / apart.back()) / 3 - 2) <= 0.1);
  }
}
