// Contacts with laws, gaps and re-contact by both methods, which share the laws and no solver.
#include "fem/bodies/bar_structure.hpp"
#include "fem/explicit/explicit_contact.hpp"
#include "impulse/contact/contacts_problem.hpp"
#include "impulse/response/wave_response.hpp"
#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace impulse;

namespace {

struct Scene {
  Bar projectile;
  double speed;
  double gap;
  ContactLaw law;
  double duration;
};

ContactTrace by_waves(const Scene& scene, double step) {
  const UniformGrid grid = grid_over(scene.duration, step);
  ContactsProblem problem;
  problem.speed_m_per_s = {scene.speed, 0};
  problem.laws = {scene.law};
  problem.gaps_m = {scene.gap};
  problem.recontact = Recontact::yes;
  return solve_contacts({wave_response(scene.projectile, grid), wave_response(bars::long_rod(), grid)}, problem)
      .traces[0];
}

ContactTrace by_elements(const Scene& scene, double step) {
  ExplicitContact contact;
  contact.speed_m_per_s = scene.speed;
  contact.step_s = step;
  contact.duration_s = scene.duration;
  contact.gap_m = scene.gap;
  contact.law = scene.law;
  contact.after_contact = AfterContact::touch_again;
  return explicit_contact(bar_structure(scene.projectile, bar_mesh_by_step(scene.projectile, step)),
                          bar_structure(bars::long_rod(), bar_mesh_by_step(bars::long_rod(), step)), contact)
      .trace;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (double value : values) most = std::max(most, std::abs(value));
  return most;
}

/// Largest difference of a column, of its largest value.
double difference(const ContactTrace& a, const ContactTrace& b, std::vector<double> ContactTrace::*column) {
  REQUIRE((a.*column).size() == (b.*column).size());
  double most = 0;
  for (std::size_t n = 0; n < (a.*column).size(); ++n) most = std::max(most, std::abs((a.*column)[n] - (b.*column)[n]));
  return most / largest(a.*column);
}

}  // namespace

TEST_CASE("cross: every law, after a gap: force, impulse, motion and energies of both methods approach each other") {
  for (const ContactLaw& law : {ContactLaw::linear(2e7), ContactLaw::hertz(2e9), ContactLaw::tan_sun(2e9, 0.094, 2e-5),
                                ContactLaw::table({{0, 1e-4, 3e-4}, {0, 1200, 6000}, {0, 300, 6000}})}) {
    const Scene scene{bars::steel_rod(0.4), 2, 3e-6, law, 400e-6};
    std::vector<double> worst;
    for (double step : {2e-6, 1e-6, 0.5e-6, 0.25e-6}) {
      const ContactTrace waves = by_waves(scene, step), elements = by_elements(scene, step);
      worst.push_back(0);
      for (const auto column : {&ContactTrace::force_N, &ContactTrace::running_impulse_Ns, &ContactTrace::indentation_m,
                                &ContactTrace::displacement_2_m, &ContactTrace::work_2_J})
        worst.back() = std::max(worst.back(), difference(waves, elements, column));
    }
    // Both are of order 2; how the ends of contact fall between samples makes single levels better or worse.
    CHECK(std::log2(worst[0] / worst[3]) / 3 > 1.8);
    CHECK(worst[3] < 5e-6);
  }
}

TEST_CASE("cross: the cone of case TCB touches the rod again, rigid faces, by both methods") {
  const Scene scene{bars::cone(Face::b), 0.93, 0, ContactLaw::rigid(), 1.15e-3};
  const double step = 0.5e-6;
  const auto again = [&](const ContactTrace& trace) {
    ContactInterval sum{HUGE_VAL, 0, 0, 0, 0, false};
    for (const ContactInterval& period : contact_intervals(trace, grid_over(scene.duration, step))) {
      if (period.start_s < 560e-6) continue;
      sum.start_s = std::min(sum.start_s, period.start_s);
      sum.end_s = std::max(sum.end_s, period.end_s);
      sum.impulse_Ns += period.impulse_Ns;
    }
    return sum;
  };
  const ContactTrace waves = by_waves(scene, step), elements = by_elements(scene, step);
  const ContactInterval a = again(waves), b = again(elements);
  CHECK(a.impulse_Ns > 0.1 * waves.running_impulse_Ns.back());
  CHECK(b.impulse_Ns == doctest::Approx(a.impulse_Ns).epsilon(0.02));
  CHECK(b.start_s == doctest::Approx(a.start_s).epsilon(0.01));
  CHECK(b.end_s == doctest::Approx(a.end_s).epsilon(0.01));
  CHECK(difference(waves, elements, &ContactTrace::running_impulse_Ns) < 0.01);
}
