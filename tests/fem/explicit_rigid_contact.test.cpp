// Rigid contacts in explicit steps: while faces stick the bodies must move as if they were one mesh.
#include "fem/bodies/bar_structure.hpp"
#include "fem/bodies/beam_structure.hpp"
#include "fem/bodies/mass_structure.hpp"
#include "fem/explicit/explicit_contacts.hpp"
#include "fem/explicit/explicit_impact.hpp"
#include "fem/explicit/first_forces.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace impulse {
namespace {

const double steel_speed = parse_material("steel").rod_wave_speed_m_per_s();

/// Force on a rod's face after a mass that joined it at t = 0 for good: the mesh with the mass added to its first node,
/// which starts with the velocity of a plastic collision of the two, by its modes.
class MassOnMesh {
 public:
  MassOnMesh(const Structure& rod, double mass_kg) : mass_(mass_kg) {
    Eigen::MatrixXd k = rod.stiffness, m = rod.mass;
    m(0, 0) += mass_kg;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> pairs(k, m);
    omega_ = pairs.eigenvalues().cwiseMax(0).cwiseSqrt();
    shape_ = pairs.eigenvectors().row(0);
  }

  /// For V = 1 m/s: the mass pushes with -M a, a = -Σ φ² M ω sin ωt.
  [[nodiscard]] double force_N(double t) const {
    return mass_ * mass_ * (shape_.array().square() * omega_.array() * (omega_.array() * t).sin()).sum();
  }

  /// The momentum that the mass has lost, the first exchange included: M (1 - v), v = Σ φ² M cos ωt.
  [[nodiscard]] double impulse_Ns(double t) const {
    return mass_ * (1 - mass_ * (shape_.array().square() * (omega_.array() * t).cos()).sum());
  }

 private:
  double mass_;
  Eigen::VectorXd omega_, shape_;
};

double largest_zigzag(const std::vector<double>& force, std::size_t from, std::size_t to) {
  double worst = 0;
  for (std::size_t n = from; n + 1 < to; ++n)
    worst = std::max(worst, std::abs(force[n + 1] - 2 * force[n] + force[n - 1]) / 4);
  return worst;
}

TEST_CASE("explicit rigid contact: a mass on a mesh pushes as the two in one mesh do; force and impulse with order 2") {
  // The mesh is the same for all steps, Courant numbers 0.5 to 0.06: what a face's mass takes from the step to the
  // force at first touch must not show in what follows.
  const Bar rod = bars::steel_rod(0.2);
  const Structure body = bar_structure(rod, bar_mesh_by_count(rod, 20));
  const double mass = 3 * mass_kg(rod.profile), crossing = 0.2 / steel_speed;
  const MassOnMesh exact(body, mass);
  std::vector<double> force_errors, impulse_errors;
  for (const std::size_t per_crossing : {40u, 80u, 160u, 320u}) {
    const double step = crossing / static_cast<double>(per_crossing);
    const ExplicitContactsResult result =
        explicit_contacts({{mass_structure(mass), 1}, {body}},
                          {.step_s = step, .duration_s = 1.5 * crossing, .laws = {ContactLaw::rigid()}, .gaps_m = {0}});
    double force = 0, impulse = 0;
    for (std::size_t n = 1; n < result.grid.size; ++n) {
      const double t = result.grid.time_s(n);
      force = std::max(force, std::abs(result.traces[0].force_N[n] - exact.force_N(t)));
      impulse = std::max(impulse, std::abs(result.traces[0].running_impulse_Ns[n] - exact.impulse_Ns(t)));
    }
    force_errors.push_back(force / face_impedance_kg_per_s(rod.profile, Face::a));
    impulse_errors.push_back(impulse / exact.impulse_Ns(1.5 * crossing));
  }
  for (const auto& errors : {force_errors, impulse_errors})
    for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
      CAPTURE(errors[i]);
      CHECK(std::abs(std::log2(errors[i] / errors[i + 1]) - 2) <= 0.1);
    }
  CHECK(force_errors.back() < 2e-3);
}

TEST_CASE("explicit rigid contact: on one mesh the energy lost is that of the faces' plastic collision, at any step") {
  // ½ μ V² of V ∫F dt, μ the faces' masses in series; it goes with the mesh.
  const Bar rod = bars::steel_rod(0.2);
  const double mass = mass_kg(rod.profile), crossing = 0.2 / steel_speed;
  for (const std::size_t count : {10u, 40u})
    for (const double courant : {1.0, 0.5, 0.1}) {
      const Structure body = bar_structure(rod, bar_mesh_by_count(rod, count));
      const double step = courant * crossing / static_cast<double>(count);
      const ExplicitImpactResult result =
          explicit_impact(mass_structure(mass), body, {.speed_m_per_s = 1, .step_s = step, .duration_s = 4 * crossing});
      const double face = body.mass.coeff(0, 0), exchanged = mass * face / (mass + face);
      // To the square of the step: a mass that moves during the half step that follows.
      CHECK(result.history.energy_error == about(0.5 * exchanged / impulse_Ns(result.history)).epsilon(0.03 * courant));
    }
}

TEST_CASE("explicit rigid contact: a contact that closes beside one that sticks leaves no zigzag in it") {
  // A hammer on a rigid mass, which meets a rod across a gap after 30 steps: the mass is in both contacts.
  const Bar hammer = bars::steel_rod(0.3, FarEnd::infinite), rod = bars::steel_rod(0.3, FarEnd::infinite);
  std::vector<double> zigzag;
  for (const std::size_t count : {20u, 40u, 80u}) {
    const double step = 0.5 * 0.3 / steel_speed / static_cast<double>(count);
    const ExplicitContactsResult result =
        explicit_contacts({{bar_structure(hammer, bar_mesh_by_count(hammer, count)), 1},
                           {mass_structure(0.1, {Face::a, Face::b})},
                           {bar_structure(rod, bar_mesh_by_count(rod, count))}},
                          {.step_s = step,
                           .duration_s = 400e-6,
                           .laws = {ContactLaw::rigid(), ContactLaw::rigid()},
                           .gaps_m = {0, 5e-6}});
    const auto met = static_cast<std::size_t>(std::ranges::find(result.traces[1].in_contact, true) -
                                              result.traces[1].in_contact.begin());
    REQUIRE(met + 80 < result.grid.size);
    REQUIRE(result.traces[0].in_contact[met]);
    for (const ContactTrace& trace : result.traces)
      zigzag.push_back(largest_zigzag(trace.force_N, result.grid.size - 40, result.grid.size) /
                       result.traces[0].force_N[0]);
  }
  for (const double part : zigzag) CHECK(part <= 2e-3);
}

TEST_CASE(
    "explicit rigid contact: what begins to act leaves closing faces at one velocity and sticking ones at theirs") {
  const Structure a = mass_structure(1), b = mass_structure(3, {Face::a, Face::b}), c = mass_structure(2);
  const std::vector<ExplicitBody> row{{a, 1}, {b}, {c}};
  const double step = 1e-6;
  const JoinedBodies bodies(row, step);
  const MeetingForces alone = meeting_forces(bodies, {0}, {}, step), beside = meeting_forces(bodies, {0}, {1}, step);
  // ½Δt F is the momentum of a plastic collision: with the second mass, or with the second and third as one.
  CHECK(alone.acting_N[0] * step / 2 == about(1 * 3 / 4.0).epsilon(1e-14));
  CHECK(alone.acting_N[1] == 0);
  CHECK(beside.acting_N[0] * step / 2 == about(1 * 5 / 6.0).epsilon(1e-14));
  CHECK(beside.acting_N[1] * step / 2 == about(2 / 6.0).epsilon(1e-14));
  CHECK_FALSE(alone.continuous_N);
}

TEST_CASE("explicit rigid contact: faces that let go do not approach each other any more") {
  // Free and supported beams meet at two points many times, often for a single step.
  const auto material = parse_material("steel");
  Beam upper{.length_m = 0.3,
             .width_m = 0.02,
             .height_m = 0.01,
             .material = material,
             .supports = BeamSupports::free,
             .contacts_at = {0.3, 0.8}};
  Beam lower{.length_m = 0.4,
             .width_m = 0.02,
             .height_m = 0.015,
             .material = material,
             .supports = BeamSupports::simple,
             .contacts_at = {0.35, 0.7}};
  const double step = 4e-6;
  const auto body = [&](const Beam& beam) { return beam_structure(beam, {}, beam_mesh_by_step(beam, {}, step)); };
  const ExplicitContactsResult result =
      explicit_contacts({{body(upper), 1}, {body(lower)}}, {.step_s = step,
                                                            .duration_s = 3e-3,
                                                            .laws = {ContactLaw::rigid(), ContactLaw::rigid()},
                                                            .gaps_m = {0, 100e-6},
                                                            .after_contact = AfterContact::touch_again});
  std::size_t releases = 0, short_ones = 0;
  for (const ContactTrace& trace : result.traces)
    for (std::size_t n = 1; n + 1 < result.grid.size; ++n) {
      if (trace.force_N[n - 1] <= 0 || trace.force_N[n] > 0) continue;
      ++releases;
      if (n < 2 || trace.force_N[n - 2] <= 0) ++short_ones;
      CHECK(trace.velocity_1_m_per_s[n] - trace.velocity_2_m_per_s[n] <= 1e-9);
    }
  CHECK(releases >= 10);
  CHECK(short_ones >= 3);
}

TEST_CASE("explicit rigid contact: the first sample without a wave admittance shows the next one's force") {
  const Bar rod = bars::steel_rod(0.2);
  Structure body = bar_structure(rod, bar_mesh_by_count(rod, 20));
  const double step = 0.25 * 0.2 / steel_speed / 20;
  const auto history = [&] {
    return explicit_impact(mass_structure(0.1), body, {.speed_m_per_s = 1, .step_s = step, .duration_s = 40e-6})
        .history;
  };
  const ImpactHistory known = history();
  body.wave_admittance.setZero();
  const ImpactHistory unknown = history();
  CHECK(known.force_N[0] == about(face_impedance_kg_per_s(rod.profile, Face::a)).epsilon(1e-12));
  CHECK(unknown.force_N[0] == unknown.force_N[1]);
  // Only the record differs.
  for (std::size_t n = 1; n < known.grid.size; ++n) REQUIRE(unknown.force_N[n] == known.force_N[n]);
  CHECK(impulse_Ns(unknown) == impulse_Ns(known));
  // Rigid masses exchange all they have on one sample.
  const ExplicitContactsResult clash =
      explicit_contacts({{mass_structure(1), 1}, {mass_structure(3)}},
                        {.step_s = 1e-3, .duration_s = 0.01, .laws = {ContactLaw::rigid()}, .gaps_m = {0}});
  CHECK(clash.traces[0].force_N[0] == about(2 * 0.75 / 1e-3).epsilon(1e-12));
  CHECK(clash.traces[0].force_N[1] == 0);
  CHECK(clash.traces[0].running_impulse_Ns.back() == about(0.75).epsilon(1e-12));
}

}  // namespace
}  // namespace impulse
