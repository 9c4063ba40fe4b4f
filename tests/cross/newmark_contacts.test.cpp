// Two elastic beams that meet at two points: impulse responses of their modes in the marched contact equation against
// Newmark's method on the assembled matrices, complementarity step by step in both.
#include "tests/support/newmark_contacts.hpp"

#include "fem/bodies/beam_structure.hpp"
#include "impulse/contact/contacts_problem.hpp"
#include "impulse/response/modal_response.hpp"
#include "lib/model/modal_model.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace impulse;

namespace {

constexpr double speed = 1;

Structure upper(std::size_t elements) {
  const Beam beam{0.3, 0.02, 0.010, parse_material("steel"), BeamSupports::free, {0.3, 0.8}};
  return beam_structure(beam, {}, beam_mesh_by_count(beam, {}, elements, MassMatrix::consistent));
}

Structure lower(std::size_t elements) {
  const Beam beam{0.4, 0.02, 0.015, parse_material("steel"), BeamSupports::simple, {0.35, 0.7}};
  return beam_structure(beam, {}, beam_mesh_by_count(beam, {}, elements, MassMatrix::consistent));
}

ContactsSolution marched(const newmark_contacts::Scene& scene, const UniformGrid& grid) {
  ContactsProblem problem;
  problem.speed_m_per_s = {scene.speed_m_per_s, 0};
  for (const double k : scene.stiffness_N_per_m) problem.laws.push_back(ContactLaw::linear(k));
  problem.gaps_m = scene.gaps_m;
  problem.recontact = Recontact::yes;
  return solve_contacts(
      {modal_response(modal_model(scene.body_1), grid), modal_response(modal_model(scene.body_2), grid)}, problem);
}

/// Samples at which one contact bears after both did, while the other is open.
std::size_t samples_borne_alone(const ContactTrace& bearing, const ContactTrace& open) {
  std::size_t count = 0;
  bool both = false;
  for (std::size_t n = 0; n < bearing.in_contact.size(); ++n) {
    both = both || (bearing.in_contact[n] && open.in_contact[n]);
    if (both && bearing.in_contact[n] && !open.in_contact[n]) ++count;
  }
  return count;
}

/// Of all contacts together.
double relative_l2(const std::vector<std::vector<double>>& reference, const std::vector<std::vector<double>>& other) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < reference.size(); ++i)
    for (std::size_t n = 0; n < reference[i].size(); ++n) {
      difference += std::pow(reference[i][n] - other[i][n], 2);
      size += std::pow(reference[i][n], 2);
    }
  return std::sqrt(difference / size);
}

}  // namespace

TEST_CASE("cross: two elastic beams meet at two points, by impulse responses and by Newmark's method: order 2") {
  const Structure body_1 = upper(6), body_2 = lower(6);
  const newmark_contacts::Scene scene{body_1, body_2, speed, {1e6, 2e6}, {0, 100e-6}};
  std::vector<double> force_apart, impulse_apart;
  for (const double step : {2e-6, 1e-6, 0.5e-6, 0.25e-6}) {
    const UniformGrid grid = grid_over(2e-3, step);
    const ContactsSolution solution = marched(scene, grid);
    const newmark_contacts::History newmark = newmark_contacts::simulate(scene, step, grid.size);
    const ContactTrace &one = solution.traces[0], &two = solution.traces[1];
    force_apart.push_back(relative_l2(newmark.force_N, {one.force_N, two.force_N}));
    impulse_apart.push_back(relative_l2(newmark.impulse_Ns, {one.running_impulse_Ns, two.running_impulse_Ns}));
    CHECK(solution.energy_error < 1e-10);
    // The second point parts alone, for more than a tenth of the record.
    CHECK(samples_borne_alone(one, two) > grid.size / 10);
  }
  CHECK(force_apart.back() < 1e-6);
  CHECK(std::abs(std::log2(force_apart.front() / force_apart.back()) / 3 - 2) <= 0.1);
  // The impulse is made by when a point closes and opens within a step, which scatters from step to step.
  CHECK(impulse_apart.back() < 1e-6);
  CHECK(impulse_apart.back() < impulse_apart.front() / 16);
}
