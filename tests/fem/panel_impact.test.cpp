#include "fem/reduced_basis/panel_impact.hpp"

#include "tests/support/shells.hpp"

#include <doctest/doctest.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace impulse {
namespace {

double largest_deflection(const ContactTrace& trace) {
  return *std::max_element(trace.displacement_2_m.begin(), trace.displacement_2_m.end());
}

/// The 20-ply panel with a radius of curvature of `ratio` thicknesses, struck in the middle by the steel sphere.
struct TwentyPly {
  explicit TwentyPly(double thickness_m = 2.69e-3, double ratio = 4000)
      : shell(shells::panel(
            {.length_m = 0.1524, .width_m = 0.1016, .curvature = Curvature::along_y, .radius_m = ratio * thickness_m},
            laminate(layers_of("[0/45/0/-45/0]2s", parse_ply("graphite-epoxy"), thickness_m)), "IIII", 8, 8)),
        body(shell_structure(shell, {{0.0762, 0.0508}})),
        thickness(thickness_m) {}

  [[nodiscard]] PanelImpact run(double step_s, double duration_s, const PanelImpactOptions& options,
                                StepRule rule = StepRule::newmark) const {
    PanelImpact panel(shell, body, ContactLaw::tan_sun(1.413e9, 0.094, 1.667e-4),
                      {.striker_mass_kg = 8.537e-3, .speed_m_per_s = 3, .step_s = step_s, .rule = rule}, options);
    for (int k = 0; k < std::lround(duration_s / step_s); ++k) panel.advance();
    return panel;
  }

  [[nodiscard]] double deflection(const PanelImpact& panel) const {
    return largest_deflection(panel.impact().trace()) / thickness;
  }

  Shell shell;
  Structure body;
  double thickness;
};

double impulse_of(const PanelImpact& panel) { return panel.impact().trace().running_impulse_Ns.back(); }

/// Relative: doctest's Approx adds the tolerance itself to small values.
double apart(double a, double b) { return std::abs(a / b - 1); }

TEST_CASE("largest deflection and force at 28 µs by 6, 20, 40 and 60 modes, flexural or any") {
  const TwentyPly panel;
  const std::size_t counts[4] = {6, 20, 40, 60};
  // Of an independent program with the same element; the thesis has .1385, .1408, .1424, .1425 and 636.2, 435.4, 301.4,
  // 295.8 N.
  const double flexural_w[4] = {.1398, .1407, .1419, .1420}, flexural_force[4] = {639.6, 437.8, 289.3, 296.7};
  const double any_w[4] = {.1398, .1407, .1415, .1419}, any_force[4] = {639.6, 437.8, 298.4, 292.8};
  const double thesis_w[4] = {.1385, .1408, .1424, .1425}, thesis_force[4] = {636.22, 435.40, 301.44, 295.81};
  for (std::size_t i = 0; i < 4; ++i)
    for (const ModeKind kind : {ModeKind::flexural, ModeKind::any}) {
      const PanelImpact run = panel.run(2e-7, 4e-4,
                                        {.method = PanelMethod::modes,
                                         .geometry = Geometry::linear,
                                         .vectors = counts[i],
                                         .modes = kind,
                                         .left_out = LeftOut::rigid});
      const bool flexural = kind == ModeKind::flexural;
      const double force = run.impact().trace().force_N[140];
      CHECK(apart(panel.deflection(run), flexural ? flexural_w[i] : any_w[i]) <= 0.01);
      CHECK(apart(force, flexural ? flexural_force[i] : any_force[i]) <= 0.01);
      if (flexural) CHECK(apart(panel.deflection(run), thesis_w[i]) <= 0.01);
      // The thesis' force at 40 modes lies between the two kinds', 301.4 against 289.3 and 298.5.
      CHECK(apart(force, thesis_force[i]) <= (flexural && i == 2 ? 0.045 : 0.0125));
    }
}

TEST_CASE("twenty Ritz vectors or sixty modes with what they leave out give the impact of the whole mesh") {
  const TwentyPly panel;
  const PanelImpact whole = panel.run(1e-6, 4e-4, {.geometry = Geometry::linear});
  for (const PanelMethod method : {PanelMethod::ritz, PanelMethod::modes}) {
    const PanelImpact run =
        panel.run(1e-6, 4e-4,
                  {.method = method, .geometry = Geometry::linear, .vectors = method == PanelMethod::ritz ? 40U : 60U});
    CHECK(apart(panel.deflection(run), panel.deflection(whole)) <= 0.003);
    CHECK(apart(impulse_of(run), impulse_of(whole)) <= 0.003);
  }
}

TEST_CASE("tensors follow the nonlinear mesh within one percent: curved and half as thick" *
          doctest::test_suite("slow")) {
  for (const double thickness : {2.69e-3, 1.345e-3})
    for (const double ratio : {4000.0, 250.0, -250.0}) {
      CAPTURE(thickness);
      CAPTURE(ratio);
      const TwentyPly panel(thickness, ratio);
      const PanelImpact whole = panel.run(1e-6, 6e-4, {});
      const PanelImpact reduced = panel.run(1e-6, 6e-4, {.method = PanelMethod::tensor});
      CHECK(apart(panel.deflection(reduced), panel.deflection(whole)) <= 0.01);
      CHECK(apart(impulse_of(reduced), impulse_of(whole)) <= 0.01);
    }
}

/// A drop-weight panel of AS4/3502, [45/0/-45/90]ns, 8 × 4 elements, flat (radius 0) or curved.
ContactTrace drop_weight(bool clamped, std::size_t plies, double radius_m, const PanelImpactOptions& options) {
  const double length = (clamped ? 9.5 : 9.0) * 25.4e-3, width = (clamped ? 4.5 : 4.0) * 25.4e-3;
  PanelShape shape{.length_m = length, .width_m = width};
  if (radius_m != 0) {
    shape.curvature = Curvature::along_y;
    shape.radius_m = radius_m;
  }
  const Laminate laminate_of_plies =
      laminate(layers_of(plies == 8 ? "[45/0/-45/90]s" : "[45/0/-45/90]2s", parse_ply("as4-3502:1600kg/m3"),
                         static_cast<double>(plies) * 0.127e-3));
  const Shell shell(shells::panel(shape, laminate_of_plies, clamped ? "CCCC" : "IIII", 8, 4));
  const Structure body = shell_structure(shell, {{length / 2, width / 2}});
  PanelImpact run(shell, body, ContactLaw::hertz(9.4e8),
                  {.striker_mass_kg = 1.134, .speed_m_per_s = 1.0936, .step_s = 5e-6}, options);
  for (int k = 0; k < 2000; ++k) run.advance();
  return run.impact().trace();
}

TEST_CASE(
    "tensors follow the drop-weight panels within one percent: flat and curved at deflections of three thicknesses" *
    doctest::test_suite("slow")) {
  double most = 0;
  for (const bool clamped : {true, false})
    for (const std::size_t plies : {8U, 16U})
      for (const double radius : {0.0, 1.524, -1.524}) {
        CAPTURE(clamped);
        CAPTURE(plies);
        CAPTURE(radius);
        const ContactTrace whole = drop_weight(clamped, plies, radius, {});
        const ContactTrace reduced = drop_weight(clamped, plies, radius, {.method = PanelMethod::tensor});
        CHECK(apart(largest_deflection(reduced), largest_deflection(whole)) <= 0.01);
        CHECK(apart(reduced.running_impulse_Ns.back(), whole.running_impulse_Ns.back()) <= 0.01);
        most = std::max(most, largest_deflection(whole) / (static_cast<double>(plies) * 0.127e-3));
      }
  CHECK(most > 3);
}

TEST_CASE("energy over 2 ms with the law's loss: kept by the conserving step; order 2 by Newmark's; lost by Wilson's" *
          doctest::test_suite("slow")) {
  const TwentyPly panel(2.69e-3, 250);
  const auto drift = [&](double step, StepRule rule) { return panel.run(step, 2e-3, {}, rule).energy_drift(); };
  const PanelImpact conserved = panel.run(2e-6, 2e-3, {}, StepRule::conserving);
  // A thousand steps whose equilibrium is found to 1e-8 each.
  CHECK(std::abs(conserved.energy_drift()) <= 1e-7);
  // What the law dissipates is part of the sum: without it the drift were this.
  CHECK(conserved.impact().trace().dissipated_J.back() > 0.03 * 0.5 * 8.537e-3 * 9);
  const double coarse = drift(4e-6, StepRule::newmark), fine = drift(0.5e-6, StepRule::newmark);
  CHECK(std::abs(drift(2e-6, StepRule::newmark)) <= 1e-5);
  CHECK(std::abs(fine) <= 1e-6);
  // Over three halvings; from one to the next the drift at a moment scatters.
  CHECK(std::abs(std::log2(coarse / fine) / 3 - 2) <= 0.25);
  CHECK(drift(4e-6, StepRule::wilson) < -0.05);
  CHECK(drift(1e-6, StepRule::wilson) < -0.003);
}

TEST_CASE("a step by tensors knows nothing of the mesh") {
  // The same coordinates on meshes of 4 x 4 and 8 x 8: the equations have the same sizes, so the same work per step,
  // and a step's record for later holds coordinates alone.
  std::vector<Eigen::Index> sizes;
  for (const std::size_t count : {4U, 8U}) {
    const Shell shell(shells::panel({.length_m = 0.1524, .width_m = 0.1016},
                                    laminate(layers_of("[0/45/0/-45/0]2s", parse_ply("graphite-epoxy"), 2.69e-3)),
                                    "IIII", count, count));
    const Structure body = shell_structure(shell, {{0.0762, 0.0508}});
    PanelImpact run(shell, body, ContactLaw::hertz(1.413e9),
                    {.striker_mass_kg = 8.537e-3, .speed_m_per_s = 3, .step_s = 2e-6},
                    {.method = PanelMethod::tensor, .vectors = 30, .nonlinear_vectors = 6});
    for (int k = 0; k < 20; ++k) run.advance();
    const PanelStep step = run.last_step();
    sizes.push_back(step.before.size() + step.after.size() + step.change_of_velocity.size());
    const double then = run.unbalanced_force();
    for (int k = 0; k < 20; ++k) run.advance();
    CHECK(run.unbalanced_force(step) == then);
    CHECK(run.unbalanced_force() != then);
    CHECK(run.set_up().factorisation_s > 0);
    CHECK(run.set_up().tensors_s > 0);
  }
  CHECK(sizes[0] == 90);
  CHECK(sizes[1] == 90);
}

TEST_CASE("tensors: one curved panel within one percent, the energy kept, nothing much unbalanced") {
  const TwentyPly panel(1.345e-3, 250);
  const PanelImpact whole = panel.run(2e-6, 5e-4, {});
  const PanelImpact reduced = panel.run(2e-6, 5e-4, {.method = PanelMethod::tensor}, StepRule::conserving);
  CHECK(apart(panel.deflection(reduced), panel.deflection(whole)) <= 0.01);
  CHECK(apart(impulse_of(reduced), impulse_of(whole)) <= 0.01);
  CHECK(std::abs(reduced.energy_drift()) <= 1e-6);
  CHECK(whole.unbalanced_force() <= 1e-5);
  CHECK(reduced.unbalanced_force() <= 0.2);
}

TEST_CASE("an updated Ritz basis grows, carries the motion on and comes nearer to the mesh") {
  const TwentyPly panel(1.345e-3, 250);
  const PanelImpact whole = panel.run(2e-6, 3e-4, {});
  PanelImpactOptions options{.method = PanelMethod::ritz, .vectors = 20};
  const PanelImpact plain = panel.run(2e-6, 3e-4, options);
  options.update_s = {1e-4, 2e-4};
  const PanelImpact updated = panel.run(2e-6, 3e-4, options);
  CHECK(updated.update_count() == 2);
  // Counts go on through updates: 150 steps, and a matrix for each basis.
  CHECK(updated.impact().iteration_count() >= 150);
  CHECK(updated.impact().factorisation_count() == 3);
  // The whole panel's displacement is the basis' one; Ritz vectors leave nothing out at the contact.
  for (const PanelImpact* run : {&plain, &updated})
    CHECK(apart(panel.body.contacts.col(0).dot(run->displacement()), run->impact().trace().displacement_2_m.back()) <=
          1e-6);
  CHECK(updated.unknowns() > plain.unknowns() + 20);
  const auto error = [&](const PanelImpact& run) {
    return (run.displacement() - whole.displacement()).norm() / whole.displacement().norm();
  };
  CHECK(error(updated) < error(plain));
  options.update_s.clear();
  options.update_tolerance = 0.05;
  CHECK(panel.run(2e-6, 3e-4, options).update_count() >= 1);
}

TEST_CASE("updates by the unbalanced force leave ten steps between them") {
  const TwentyPly panel;
  PanelImpactOptions options{.method = PanelMethod::ritz, .vectors = 6, .update_tolerance = 1e-9, .update_vectors = 1};
  CHECK(panel.run(2e-6, 9e-5, options).update_count() == 4);  // after 10, 20, 30 and 40 of 45 steps
}

TEST_CASE("an update after the contact begins with the deflection under the inertia of the first vector") {
  const TwentyPly panel(2.69e-3, 250);
  PanelImpactOptions options{.method = PanelMethod::ritz, .vectors = 3, .update_vectors = 1};
  const PanelImpact before = panel.run(2e-6, 6e-4, options);
  REQUIRE(!before.impact().in_contact());
  options.update_s = {6e-4};
  const PanelImpact updated = panel.run(2e-6, 6.4e-4, options);
  REQUIRE(updated.unknowns() == 4);
  // Its span, found anew: ψ₁, ψ₂, ψ₃ of the stiffness at rest, and K_T⁻¹ M ψ₁ of the tangent at the update.
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> rest(panel.body.stiffness),
      tangent(panel.shell.tangent(before.displacement()));
  Eigen::MatrixXd span(panel.body.mass.rows(), 4);
  span.col(0) = rest.solve(panel.body.contacts.col(0));
  span.col(3) = tangent.solve(panel.body.mass * span.col(0));
  for (int i : {1, 2}) span.col(i) = rest.solve(panel.body.mass * span.col(i - 1));
  for (int i = 0; i < 4; ++i) {  // Gram and Schmidt, twice
    for (int again = 0; again < 2; ++again)
      span.col(i) -= span.leftCols(i) * (span.leftCols(i).transpose() * (panel.body.mass * span.col(i)));
    span.col(i) /= std::sqrt(span.col(i).dot(panel.body.mass * span.col(i)));
  }
  const Eigen::VectorXd q = updated.displacement();
  const Eigen::VectorXd outside = q - span * (span.transpose() * (panel.body.mass * q));
  CHECK(outside.norm() <= 1e-9 * q.norm());
}

TEST_CASE("updates that cannot be are refused") {
  const TwentyPly panel;
  CHECK_THROWS_WITH_AS((void)panel.run(2e-6, 3e-4, {.method = PanelMethod::ritz, .update_s = {1e-4, 1.01e-4}}),
                       doctest::Contains("less than a step of 2e-06 s after 0.0001 s; update less often"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)panel.run(2e-6, 3e-4, {.method = PanelMethod::modes, .update_s = {1e-4}}),
                       "only a basis of Ritz vectors is updated", std::invalid_argument);
}

}  // namespace
}  // namespace impulse
