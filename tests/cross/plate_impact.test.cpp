// Impacts across a plate by impulse responses and by explicit integration of the plate's modes beside bar elements.
#include "fem/bodies/bar_structure.hpp"
#include "fem/bodies/mass_structure.hpp"
#include "fem/bodies/modal_structure.hpp"
#include "fem/explicit/explicit_contact.hpp"
#include "impulse/bodies/missing_answer.hpp"
#include "impulse/bodies/ritz_plate.hpp"
#include "impulse/contact/contacts_problem.hpp"
#include "impulse/response/mass_response.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/wave_response.hpp"
#include "lib/law/hertz.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace impulse;

namespace {

constexpr double speed = 3, thickness = 0.00269;
const double sphere_mass = std::numbers::pi / 6 * 7960 * std::pow(0.0127, 3);

DenseStructure struck_in_the_middle(const PlateShape& shape, const char* layup, std::size_t terms) {
  Plate plate;
  plate.shape = shape;
  plate.laminate = laminate(layers_of(layup, parse_ply("graphite-epoxy"), thickness));
  plate.edges = parse_plate_edges("WWWW");
  plate.theory = Plate::Theory::thin;
  const RitzPlate ritz(plate, terms);
  DenseStructure body = ritz.structure();
  body.contacts = ritz.deflection({0, 0});
  body.residual_flexibility = MissingAnswer(ritz, body, {{0, 0}}).flexibility();
  return body;
}

ModalModel modes_to(const DenseStructure& body, double highest_frequency_Hz) {
  return modal_model(body,
                     {.highest_frequency_Hz = highest_frequency_Hz, .residual = ModalOptions::Residual::attached});
}

const DenseStructure& panel() {
  static const DenseStructure body = struck_in_the_middle(rectangle(0.1524, 0.1016), "[0/45/0/-45/0]2s", 24);
  return body;
}

ContactTrace by_responses(const Response& projectile, const DenseStructure& plate, const ContactLaw& law,
                          const UniformGrid& grid) {
  ContactsProblem problem;
  problem.speed_m_per_s = {speed, 0};
  problem.laws = {law};
  problem.gaps_m = {0};
  problem.recontact = Recontact::yes;
  return solve_contacts({projectile, modal_response(modes_to(plate, 0.5 / grid.step_s), grid)}, problem).traces[0];
}

ContactTrace by_explicit_steps(const Structure& projectile, const DenseStructure& plate, const ContactLaw& law,
                               const UniformGrid& grid) {
  const Structure target = modal_structure(modes_to(plate, 1 / (2 * std::numbers::pi * grid.step_s)), grid.step_s);
  return explicit_contact(projectile, target,
                          {.speed_m_per_s = speed,
                           .step_s = grid.step_s,
                           .duration_s = grid.duration_s(),
                           .law = law,
                           .after_contact = AfterContact::touch_again})
      .trace;
}

double largest(const std::vector<double>& values) { return *std::ranges::max_element(values); }

double apart(double a, double b) { return std::abs(a / b - 1); }

}  // namespace

TEST_CASE("cross: a sphere on the 20-ply panel, law of Tan and Sun, both methods at the converged answer") {
  const UniformGrid grid = grid_over(800e-6, 0.2e-6);
  const ContactLaw law = ContactLaw::tan_sun(1.413e9, 0.094, 1.667e-4);
  for (const ContactTrace& trace : {by_responses(mass_response(sphere_mass, grid), panel(), law, grid),
                                    by_explicit_steps(mass_structure(sphere_mass), panel(), law, grid)}) {
    const auto intervals = contact_intervals(trace, grid);
    REQUIRE(intervals.size() == 2);
    CHECK(intervals[0].peak_force_N == about(313.4).epsilon(0.003));
    CHECK(intervals[0].peak_time_s == about(29.1e-6).epsilon(0.01));
    CHECK(intervals[0].end_s == about(228.8e-6).epsilon(0.003));
    CHECK(intervals[1].start_s == about(664.9e-6).epsilon(0.003));
    CHECK(intervals[1].end_s == about(731.4e-6).epsilon(0.003));
    CHECK(largest(trace.displacement_2_m) / thickness == about(0.1433).epsilon(0.003));
  }
}

TEST_CASE("cross: a sphere on a square cross-ply plate, Hertz' law with the ply's E2") {
  const DenseStructure plate = struck_in_the_middle(rectangle(0.2, 0.2), "[0/90/0/90/0]s", 28);
  const ContactLaw law = ContactLaw::hertz(8.1159e8);
  const UniformGrid grid = grid_over(900e-6, 0.2e-6);
  for (const ContactTrace& trace : {by_responses(mass_response(sphere_mass, grid), plate, law, grid),
                                    by_explicit_steps(mass_structure(sphere_mass), plate, law, grid)}) {
    const auto intervals = contact_intervals(trace, grid);
    REQUIRE(intervals.size() >= 2);
    CHECK(intervals[0].peak_force_N == about(309.8).epsilon(0.005));
    CHECK(intervals[0].peak_time_s == about(38.8e-6).epsilon(0.01));
    CHECK(intervals[0].end_s == about(214.4e-6).epsilon(0.005));
    CHECK(intervals[1].start_s == about(332.0e-6).epsilon(0.005));
    CHECK(intervals[1].end_s == about(401.9e-6).epsilon(0.005));
    CHECK(intervals[1].peak_force_N == about(86.7).epsilon(0.01));
    CHECK(largest(trace.displacement_2_m) == about(427.4e-6).epsilon(0.005));
  }
}

TEST_CASE("cross: a cone's small face on the panel, the difference between the methods shrinking with the step") {
  // Of the sphere's mass, faces 1 : 15.
  const Bar cone{{{0.1, 0.83e-3, 12.45e-3, parse_material("206GPa:7960kg/m3")}}, {Face::a}, FarEnd::free};
  std::vector<double> differences;
  for (const double step : {0.8e-6, 0.4e-6, 0.2e-6}) {
    const UniformGrid grid = grid_over(400e-6, step);
    const ContactTrace a = by_responses(wave_response(cone, grid), panel(), ContactLaw::rigid(), grid);
    const ContactTrace b =
        by_explicit_steps(bar_structure(cone, bar_mesh_by_step(cone, step)), panel(), ContactLaw::rigid(), grid);
    differences.push_back(std::max({apart(largest(a.force_N), largest(b.force_N)),
                                    apart(a.running_impulse_Ns.back(), b.running_impulse_Ns.back()),
                                    apart(largest(a.displacement_2_m), largest(b.displacement_2_m))}));
  }
  CHECK(differences.front() < 0.02);
  CHECK(differences.back() < 0.6 * differences.front());
}
