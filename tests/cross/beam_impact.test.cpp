// Impacts across a beam by impulse responses and by explicit finite elements, which share no code beyond lib/.
#include "fem/bodies/bar_structure.hpp"
#include "fem/bodies/beam_structure.hpp"
#include "fem/bodies/mass_structure.hpp"
#include "fem/explicit/explicit_contact.hpp"
#include "impulse/contact/contact_equation.hpp"
#include "impulse/contact/contacts_problem.hpp"
#include "impulse/exact/beam_modes.hpp"
#include "impulse/response/mass_response.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/wave_response.hpp"
#include "lib/law/hertz.hpp"
#include "lib/law/impact_history.hpp"
#include "tests/support/about.hpp"
#include "tests/support/beams.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace impulse;

namespace {

constexpr double speed = 0.01, duration = 400e-6;

struct Answer {
  double peak_N = 0;
  double peak_time_s = 0;
  double impulse_Ns = 0;
  double deflection_m = 0;
  double deflection_time_s = 0;
};

/// Largest deflection from the displacement of the beam under the contact.
Answer answer(const UniformGrid& grid, const std::vector<double>& force, double impulse,
              const std::vector<double>& deflection) {
  const auto peak = std::ranges::max_element(force), deepest = std::ranges::max_element(deflection);
  return {*peak, grid.step_s * static_cast<double>(peak - force.begin()), impulse, *deepest,
          grid.step_s * static_cast<double>(deepest - deflection.begin())};
}

Answer answer(const UniformGrid& grid, const ContactTrace& trace) {
  return answer(grid, trace.force_N, trace.running_impulse_Ns.back(), trace.displacement_2_m);
}

Answer answer(const ImpactHistory& history) {
  std::vector<double> deflection{0};
  for (std::size_t i = 1; i < history.velocity_2_m_per_s.size(); ++i)
    deflection.push_back(deflection.back() +
                         history.grid.step_s * (history.velocity_2_m_per_s[i - 1] + history.velocity_2_m_per_s[i]) / 2);
  return answer(history.grid, history.force_N, impulse_Ns(history), deflection);
}

/// Steel cone of the mass of the sphere of 1 cm, about: lengths and diameters in m, struck at end A or B.
Bar cone(Face face) { return {{{0.112, 0.582e-3, 11.64e-3, beams::timoshenko().material}}, {face}, FarEnd::free}; }

ModalModel exact_modes(double step) {
  return exact_beam_modes(beams::timoshenko(), {.highest_frequency_Hz = 0.5 / step});
}

double largest_difference(const Answer& a, const Answer& b) {
  return std::max({std::abs(a.peak_N / b.peak_N - 1), std::abs(a.impulse_Ns / b.impulse_Ns - 1),
                   std::abs(a.deflection_m / b.deflection_m - 1)});
}

}  // namespace

TEST_CASE("cross: Timoshenko's sphere on a beam, by impulse responses and by explicit elements") {
  const Material steel = beams::timoshenko().material;
  const double mass = steel.density_kg_per_m3 * 4 / 3 * std::numbers::pi * 1e-6;
  const ContactLaw law = ContactLaw::hertz(hertz_stiffness(0.01, steel, contact_modulus_Pa(steel)));
  const double step = 0.1e-6;
  const UniformGrid grid = grid_over(duration, step);
  ContactsProblem problem;
  problem.speed_m_per_s = {speed, 0};
  problem.laws = {law};
  problem.gaps_m = {0};
  const ContactsSolution by_modes =
      solve_contacts({mass_response(mass, grid), modal_response(exact_modes(step), grid)}, problem);
  const ExplicitContact contact{.speed_m_per_s = speed, .step_s = step, .duration_s = duration, .law = law};
  // What the published meshes had, and what the step is stable for.
  for (const std::size_t elements : {26u, 0u}) {
    const BeamMesh mesh = elements > 0 ? beam_mesh_by_count(beams::timoshenko(), {}, elements, MassMatrix::lumped)
                                       : beam_mesh_by_step(beams::timoshenko(), {}, step);
    const ExplicitContactResult by_elements =
        explicit_contact(mass_structure(mass), beam_structure(beams::timoshenko(), {}, mesh), contact);
    const Answer one = answer(grid, by_modes.traces[0]), two = answer(grid, by_elements.trace);
    // Exact modal propagation, computed independently, all digits converged; one contact.
    for (const Answer& a : {one, two}) {
      CHECK(a.peak_N == about(4.9771).epsilon(5e-5));
      CHECK(a.peak_time_s == about(72.56e-6).epsilon(2e-3));
      CHECK(a.deflection_m == about(1.12476e-6).epsilon(5e-5));
      CHECK(a.deflection_time_s == about(323.7e-6).epsilon(1e-3));
    }
    CHECK(contact_intervals(by_modes.traces[0], grid).size() == 1);
    CHECK(contact_intervals(by_modes.traces[0], grid)[0].end_s == about(156.40e-6).epsilon(1e-4));
    CHECK(contact_intervals(by_elements.trace, grid)[0].end_s == about(156.40e-6).epsilon(1e-4));
    CHECK(largest_difference(one, two) < 2e-5);
  }
}

TEST_CASE("cross: a cone's small face on a beam, the difference between the methods shrinking with the step") {
  std::vector<double> apart;
  for (const double step : {0.8e-6, 0.4e-6, 0.2e-6, 0.1e-6}) {
    const UniformGrid grid = grid_over(duration, step);
    const ImpactHistory by_waves = solve_contact(
        wave_response(cone(Face::a), grid), modal_response(exact_modes(step), grid), {speed}, ContactMethod::product);
    const ExplicitImpactResult by_elements =
        explicit_impact(bar_structure(cone(Face::a), bar_mesh_by_step(cone(Face::a), step)),
                        beam_structure(beams::timoshenko(), {}, beam_mesh_by_step(beams::timoshenko(), {}, step)),
                        {.speed_m_per_s = speed, .step_s = step, .duration_s = duration});
    apart.push_back(largest_difference(answer(by_waves), answer(by_elements.history)));
  }
  CHECK(apart.front() < 0.02);
  for (std::size_t i = 1; i < apart.size(); ++i) CHECK(apart[i] < 0.6 * apart[i - 1]);
  CHECK(apart.back() < 1e-4);
}

TEST_CASE("cross: a cone of 80 elements on a beam of 26, as published, within 1 % of waves and exact modes") {
  const double step = 0.2e-6;
  const UniformGrid grid = grid_over(duration, step);
  const Answer exact = answer(solve_contact(wave_response(cone(Face::a), grid), modal_response(exact_modes(step), grid),
                                            {speed}, ContactMethod::product));
  const Answer elements = answer(explicit_impact(bar_structure(cone(Face::a), bar_mesh_by_count(cone(Face::a), 80)),
                                                 beam_structure(beams::timoshenko(), {}, {26, 1, MassMatrix::lumped}),
                                                 {.speed_m_per_s = speed, .step_s = step, .duration_s = duration})
                                     .history);
  CHECK(largest_difference(exact, elements) < 0.01);
}

TEST_CASE(
    "cross: a cone's large face on a beam parts and touches again; every mode of the elements, and the elements") {
  // All modes kept leave no residual flexibility, so that the force may jump: to V Z at first touch.
  const double first_force = speed * face_impedance_kg_per_s(cone(Face::b).profile, Face::b);
  std::vector<double> peaks_apart;
  for (const double step : {0.4e-6, 0.1e-6}) {
    const UniformGrid grid = grid_over(100e-6, step);
    const BeamMesh mesh = beam_mesh_by_step(beams::timoshenko(), {}, 0.4e-6);
    const Structure beam = beam_structure(beams::timoshenko(), {}, mesh);
    ContactsProblem problem;
    problem.speed_m_per_s = {speed, 0};
    problem.laws = {ContactLaw::rigid()};
    problem.gaps_m = {0};
    problem.recontact = Recontact::yes;
    const ContactTrace by_modes =
        solve_contacts({wave_response(cone(Face::b), grid), modal_response(modal_model(beam), grid)}, problem)
            .traces[0];
    const ContactTrace by_elements =
        explicit_contact(
            bar_structure(cone(Face::b), bar_mesh_by_step(cone(Face::b), step)), beam,
            {.speed_m_per_s = speed, .step_s = step, .duration_s = 100e-6, .after_contact = AfterContact::touch_again})
            .trace;
    const Answer one = answer(grid, by_modes), two = answer(grid, by_elements);
    // Three contacts in the first 80 µs, of which the middle one grazes.
    CHECK(contact_intervals(by_modes, grid).size() >= 3);
    CHECK(contact_intervals(by_elements, grid).size() >= 3);
    CHECK(one.impulse_Ns == about(two.impulse_Ns).epsilon(0.02));
    CHECK(one.deflection_m == about(two.deflection_m).epsilon(0.02));
    CHECK(one.peak_N < first_force);
    CHECK(two.peak_N < first_force);
    peaks_apart.push_back(std::abs(one.peak_N - two.peak_N) / first_force);
  }
  CHECK(peaks_apart[1] < 0.6 * peaks_apart[0]);  // the jump is smeared in time like √Δt: 0.5
  // The elements' record begins with the force a step after first touch, for the beam has no wave admittance.
  CHECK(peaks_apart[1] < 0.06);
}

TEST_CASE("cross: the same with exact modes, whose residual flexibility is a spring that no step resolves") {
  const double first_force = speed * face_impedance_kg_per_s(cone(Face::b).profile, Face::b);
  for (const double step : {0.4e-6, 0.2e-6, 0.1e-6}) {
    const UniformGrid grid = grid_over(100e-6, step);
    ContactsProblem problem;
    problem.speed_m_per_s = {speed, 0};
    problem.laws = {ContactLaw::rigid()};
    problem.gaps_m = {0};
    problem.recontact = Recontact::yes;
    const auto march = [&](const ModalModel& beam) {
      return solve_contacts({wave_response(cone(Face::b), grid), modal_response(beam, grid)}, problem).traces[0];
    };
    const ModalModel with = exact_modes(step);
    ModalModel without = with;
    without.residual_flexibility.setZero();
    REQUIRE(with.residual_flexibility(0, 0) > 0);
    const ContactTrace spring = march(with), rigid = march(without);
    const Answer one = answer(grid, spring), two = answer(grid, rigid);
    CHECK(contact_intervals(spring, grid).size() <= 8);  // 21 and more if the spring's force alternates
    CHECK(one.peak_N < first_force * (1 + 1e-9));
    CHECK(one.impulse_Ns == about(two.impulse_Ns).epsilon(0.01));
    CHECK(one.deflection_m == about(two.deflection_m).epsilon(0.01));
  }
}

TEST_CASE("cross: a cone on plane stress, modes of the elements against the elements, the difference shrinking") {
  const BeamModel model{BeamElement::plane_stress, Quadrilateral::incompatible, 1e-3};
  std::vector<double> apart;
  for (const double step : {0.4e-6, 0.2e-6, 0.1e-6}) {
    const UniformGrid grid = grid_over(duration, step);
    const Structure beam = beam_structure(beams::timoshenko(), model, {52, 4, MassMatrix::lumped});
    const ModalModel modes =
        modal_model(beam, {.highest_frequency_Hz = 0.5 / step, .residual = ModalOptions::Residual::attached});
    const Answer one = answer(solve_contact(wave_response(cone(Face::a), grid), modal_response(modes, grid), {speed},
                                            ContactMethod::product));
    const Answer two = answer(explicit_impact(bar_structure(cone(Face::a), bar_mesh_by_step(cone(Face::a), step)), beam,
                                              {.speed_m_per_s = speed, .step_s = step, .duration_s = duration})
                                  .history);
    apart.push_back(largest_difference(one, two));
  }
  CHECK(apart.front() < 0.02);
  for (std::size_t i = 1; i < apart.size(); ++i) CHECK(apart[i] < 0.7 * apart[i - 1]);
}
