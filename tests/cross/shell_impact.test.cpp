// A sphere on the 20-ply panel, small displacements: the modes of the mesh in the contact equation against the whole
// mesh marched together with striker and law, implicitly, and by central differences with its consistent mass.
#include "fem/bodies/mass_structure.hpp"
#include "fem/explicit/explicit_contact.hpp"
#include "fem/reduced_basis/panel_impact.hpp"
#include "impulse/contact/contacts_problem.hpp"
#include "impulse/response/mass_response.hpp"
#include "impulse/response/modal_response.hpp"
#include "lib/model/modal_model.hpp"
#include "tests/support/shells.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace impulse;

namespace {

constexpr double sphere_mass = 8.537e-3, speed = 3, duration = 160e-6;

Shell curved_panel() {
  constexpr double thickness = 2.69e-3;
  return Shell(
      shells::panel({.length_m = 0.1524, .width_m = 0.1016, .curvature = Curvature::along_y, .radius_m = 0.6725},
                    laminate(layers_of("[0/45/0/-45/0]2s", parse_ply("graphite-epoxy"), thickness)), "IIII", 4, 4));
}

ContactTrace by_responses(const ModalModel& panel, const ContactLaw& law, const UniformGrid& grid) {
  ContactsProblem problem;
  problem.speed_m_per_s = {speed, 0};
  problem.laws = {law};
  problem.gaps_m = {0};
  problem.recontact = Recontact::yes;
  return solve_contacts({mass_response(sphere_mass, grid), modal_response(panel, grid)}, problem).traces[0];
}

ContactTrace by_whole_mesh(const Shell& shell, const Structure& body, const ContactLaw& law, const UniformGrid& grid) {
  PanelImpact impact(shell, body, law, {.striker_mass_kg = sphere_mass, .speed_m_per_s = speed, .step_s = grid.step_s},
                     {.geometry = Geometry::linear});
  for (std::size_t n = 1; n < grid.size; ++n) impact.advance();
  return impact.impact().trace();
}

ContactTrace by_explicit_steps(const Structure& body, const ContactLaw& law, const UniformGrid& grid) {
  return explicit_contact(mass_structure(sphere_mass), body,
                          {.speed_m_per_s = speed,
                           .step_s = grid.step_s,
                           .duration_s = grid.duration_s(),
                           .law = law,
                           .after_contact = AfterContact::touch_again})
      .trace;
}

double relative_l2(const std::vector<double>& reference, const std::vector<double>& other) {
  double difference = 0, size = 0;
  for (std::size_t n = 0; n < reference.size(); ++n) {
    difference += std::pow(reference[n] - other[n], 2);
    size += std::pow(reference[n], 2);
  }
  return std::sqrt(difference / size);
}

}  // namespace

TEST_CASE("cross: a sphere on a shell, by its modes, by the whole mesh implicitly and explicitly: order 2") {
  const Shell shell = curved_panel();
  const Structure body = shell_structure(shell, {{0.0762, 0.0508}});
  const ModalModel modes = modal_model(body);
  for (const ContactLaw& law : {ContactLaw::hertz(1.413e9), ContactLaw::tan_sun(1.413e9, 0.094, 1.667e-4)}) {
    std::vector<double> force_apart, deflection_apart, explicit_force_apart, explicit_deflection_apart;
    for (const double step : {1e-6, 0.5e-6, 0.25e-6, 0.125e-6}) {
      const UniformGrid grid = grid_over(duration, step);
      const ContactTrace responses = by_responses(modes, law, grid), mesh = by_whole_mesh(shell, body, law, grid),
                         steps = by_explicit_steps(body, law, grid);
      force_apart.push_back(relative_l2(mesh.force_N, responses.force_N));
      deflection_apart.push_back(relative_l2(mesh.displacement_2_m, responses.displacement_2_m));
      explicit_force_apart.push_back(relative_l2(steps.force_N, responses.force_N));
      explicit_deflection_apart.push_back(relative_l2(steps.displacement_2_m, responses.displacement_2_m));
    }
    CHECK(force_apart.back() < 1e-4);
    CHECK(deflection_apart.back() < 1e-5);
    CHECK(explicit_force_apart.back() < 1e-4);
    CHECK(explicit_deflection_apart.back() < 1e-5);
    for (const auto& apart : {force_apart, deflection_apart, explicit_force_apart, explicit_deflection_apart})
      for (std::size_t i = 0; i + 1 < apart.size(); ++i) CHECK(std::abs(std::log2(apart[i] / apart[i + 1]) - 2) <= 0.1);
  }
}
