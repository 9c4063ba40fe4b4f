#include "fem/implicit/implicit_impact.hpp"

#include "fem/reduced_basis/reduced_basis.hpp"
#include "lib/contract/errors.hpp"
#include "tests/support/about.hpp"
#include "tests/support/oscillator.hpp"
#include "tests/support/shells.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace impulse {
namespace {

using Eigen::VectorXd;

Structure oscillator(double stiffness) { return test::oscillator(stiffness, 1); }

ImplicitImpactSetup setup(double mass, double speed, double step, StepRule rule) {
  return {.striker_mass_kg = mass, .speed_m_per_s = speed, .step_s = step, .rule = rule};
}

/// Displacement after n free steps of an oscillator ω = 1 from d = 1; the striker is far too light to matter.
double free_displacement(StepRule rule, double step, int steps) {
  const Structure body = oscillator(1);
  const auto equations = linear_equations(body);
  ImplicitImpact run(*equations, VectorXd::Ones(1), ContactLaw::linear(1e-30), setup(1e-20, 1e-3, step, rule));
  run.change_equations(*equations, VectorXd::Ones(1), VectorXd::Ones(1), VectorXd::Zero(1));
  for (int i = 0; i < steps; ++i) run.advance();
  return run.displacement()(0);
}

TEST_CASE("a mode turns by the discrete angle: Newmark's period is (ωΔt)²/12 too long") {
  for (const double step : {0.1, 0.4, 1.0}) {
    const double angle = 2 * std::atan(step / 2);  // the constant average acceleration's
    for (const StepRule rule : {StepRule::newmark, StepRule::conserving})
      CHECK(free_displacement(rule, step, 50) == about(std::cos(50 * angle)).epsilon(1e-11));
    CHECK(step / angle - 1 == about(step * step / 12).epsilon(0.15 * step * step + 1e-3));
  }
}

/// A striker and a free mass with a linear spring between: F = √(k μ) V sin(ωt), μ the reduced mass.
double spring_error(StepRule rule, int steps) {
  const double mass = 0.5, k = 40, speed = 2, reduced = mass / (1 + mass), omega = std::sqrt(k / reduced);
  const double duration = 0.4 * std::numbers::pi / omega;
  const Structure body = oscillator(0);
  const auto equations = linear_equations(body);
  ImplicitImpact run(*equations, VectorXd::Ones(1), ContactLaw::linear(k), setup(mass, speed, duration / steps, rule));
  for (int i = 0; i < steps; ++i) run.advance();
  return std::abs(run.force_N() - std::sqrt(k * reduced) * speed * std::sin(omega * duration));
}

TEST_CASE("striker, law and body together: order 2 by every rule") {
  for (const StepRule rule : {StepRule::newmark, StepRule::conserving, StepRule::wilson}) {
    double before = spring_error(rule, 20);
    for (const int steps : {40, 80, 160}) {
      const double error = spring_error(rule, steps);
      CHECK(std::log2(before / error) == about(2).epsilon(0.05));
      before = error;
    }
  }
}

struct Struck {
  Shell shell;
  Structure body;
};

/// A thin panel that bends by more than its thickness.
Struck thin_panel() {
  PanelShape shape{.length_m = 0.15, .width_m = 0.10, .curvature = Curvature::along_y, .radius_m = 0.5};
  const Laminate plies = laminate(layers_of("[0/45/-45/90]s", parse_ply("graphite-epoxy"), 1e-3));
  Struck struck{Shell(shells::panel(shape, plies, "IIII", 4, 4)), {}};
  struck.body = shell_structure(struck.shell, {{0.06, 0.05}});
  return struck;
}

/// Relative drift of all energies over 0.4 ms, and the largest deflection per thickness.
struct Drift {
  double drift, deflection;
};

Drift drift(const MotionEquations& equations, const Struck& struck, StepRule rule, double step) {
  ImplicitImpact run(equations, struck.body.contacts.col(0), ContactLaw::tan_sun(1e9, 0.1, 1e-5),
                     setup(0.01, 8, step, rule));
  const double before = run.total_energy();
  double most = 0;
  for (int i = 0; i < std::lround(4e-4 / step); ++i) {
    run.advance();
    most = std::max(most, run.trace().displacement_2_m.back());
  }
  return {std::abs(run.total_energy() / before - 1), most / 1e-3};
}

TEST_CASE("all energies together: kept to rounding where the rule says so, the law's loss counted") {
  const Struck struck = thin_panel();
  const auto linear = linear_equations(struck.body);
  const auto nonlinear = shell_equations(struck.shell, struck.body);
  CHECK(drift(*linear, struck, StepRule::newmark, 4e-6).drift <= 1e-12);
  // Each step's equilibrium is found to 1e-8.
  const Drift conserved = drift(*nonlinear, struck, StepRule::conserving, 4e-6);
  CHECK(conserved.drift <= 1e-7);
  CHECK(conserved.deflection > 0.5);
  // Newmark's rule drifts with the step, Wilson's loses.
  const double coarse = drift(*nonlinear, struck, StepRule::newmark, 4e-6).drift;
  CHECK(coarse > 10 * conserved.drift);
  CHECK(drift(*nonlinear, struck, StepRule::newmark, 1e-6).drift < coarse / 4);
  CHECK(drift(*linear, struck, StepRule::wilson, 4e-6).drift > 1e-3);
  CHECK(drift(*linear, struck, StepRule::wilson, 1e-6).drift < 2e-3);
}

TEST_CASE("momentum: what the striker loses is the impulse, and the record's work adds up") {
  const Struck struck = thin_panel();
  const auto equations = shell_equations(struck.shell, struck.body);
  for (const StepRule rule : {StepRule::newmark, StepRule::conserving, StepRule::wilson}) {
    ImplicitImpact run(*equations, struck.body.contacts.col(0), ContactLaw::hertz(1e9), setup(0.01, 8, 2e-6, rule));
    for (int i = 0; i < 150; ++i) run.advance();
    const ContactTrace& trace = run.trace();
    CHECK(0.01 * (8 - trace.velocity_1_m_per_s.back()) == about(trace.running_impulse_Ns.back()).epsilon(1e-12));
    const double balance = trace.work_1_J.back() + trace.work_2_J.back() + trace.stored_J.back();
    CHECK(std::abs(balance) <= (rule == StepRule::wilson ? 1e-3 : 1e-12) * 0.32);
  }
}

TEST_CASE("a linear step takes one solution, and a nonlinear one only a few") {
  const Struck struck = thin_panel();
  const auto linear = linear_equations(struck.body);
  const auto nonlinear = shell_equations(struck.shell, struck.body);
  for (const MotionEquations* equations : {linear.get(), nonlinear.get()}) {
    ImplicitImpact run(*equations, struck.body.contacts.col(0), ContactLaw::hertz(1e9),
                       setup(0.01, 8, 1e-6, StepRule::newmark));
    for (int i = 0; i < 100; ++i) run.advance();
    CHECK(run.iteration_count() <= (equations == linear.get() ? 100 : 500));
  }
}

/// A curved panel of eight thin plies, whose struck side is convex: the drop weight snaps it through.
Struck snapping_panel() {
  PanelShape shape{.length_m = 0.2286, .width_m = 0.1016, .curvature = Curvature::along_y, .radius_m = 0.381};
  const Laminate plies = laminate(layers_of("[45/0/-45/90]s", parse_ply("as4-3502:1600kg/m3"), 8 * 0.127e-3));
  Struck struck{Shell(shells::panel(shape, plies, "IIII", 4, 4)), {}};
  struck.body = shell_structure(struck.shell, {{0.1143, 0.0508}});
  return struck;
}

ImplicitImpact snap(const MotionEquations& equations, const Struck& struck, StepRule rule, double step,
                    double duration) {
  // A soft contact, so that nothing but the panel sets the pace.
  ImplicitImpact run(equations, struck.body.contacts.col(0), ContactLaw::linear(5e5), setup(1.134, 1.0936, step, rule));
  for (int i = 0; i < std::lround(duration / step); ++i) run.advance();
  return run;
}

TEST_CASE("a snap-through in steps too long for the stiffness at rest: the tangent is refreshed and the order kept" *
          doctest::test_suite("slow")) {
  const Struck struck = snapping_panel();
  const auto equations = shell_equations(struck.shell, struck.body);
  const double duration = 6.4e-3;
  for (const StepRule rule : {StepRule::newmark, StepRule::conserving}) {
    std::vector<double> places;
    std::vector<std::size_t> factorisations;
    for (const double step : {40e-6, 20e-6, 10e-6, 5e-6, 2.5e-6}) {
      const ImplicitImpact run = snap(*equations, struck, rule, step, duration);
      places.push_back(run.trace().displacement_1_m.back());
      factorisations.push_back(run.factorisation_count());
    }
    CHECK(factorisations[0] > 1);
    CHECK(factorisations[1] > 1);
    CHECK(factorisations[1] < 30);  // a few steps need them, and they are kept
    CHECK(factorisations[4] == 1);
    const double limit = places[4] + (places[4] - places[3]) / 3;
    // The longest step turns the panel's stiffer modes by more than a radian.
    for (std::size_t i = 1; i + 2 < places.size(); ++i)
      CHECK(std::log2((places[i] - limit) / (places[i + 1] - limit)) == about(2).epsilon(0.05));
    CHECK(std::abs(places[1] - places[2]) <= 1e-4 * std::abs(limit));
  }
}

TEST_CASE("impacts that cannot be computed are refused") {
  const Struck struck = thin_panel();
  const auto equations = shell_equations(struck.shell, struck.body);
  const VectorXd contact = struck.body.contacts.col(0);
  const auto start = [&](const ContactLaw& law, const ImplicitImpactSetup& with) {
    return ImplicitImpact(*equations, contact, law, with);
  };
  CHECK_THROWS_WITH_AS(start(ContactLaw::rigid(), setup(1, 1, 1e-6, StepRule::newmark)),
                       "a rigid contact has no law of indentation", std::invalid_argument);
  CHECK_THROWS_WITH_AS(start(ContactLaw::hertz(1e9), setup(1, 1, 0, StepRule::newmark)), "step 0 s is not positive",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(start(ContactLaw::hertz(1e9), setup(0, 1, 1e-6, StepRule::newmark)),
                       "the striker's mass 0 kg is not positive", std::invalid_argument);
  CHECK_THROWS_WITH_AS(start(ContactLaw::hertz(1e9), setup(1, 0, 1e-6, StepRule::newmark)),
                       "the striker's speed 0 m/s is not positive", std::invalid_argument);
  ImplicitImpactSetup hasty = setup(1, 100, 2e-3, StepRule::newmark);
  hasty.equilibrium.most_iterations = 3;
  ImplicitImpact fast = start(ContactLaw::hertz(1e9), hasty);
  CHECK_THROWS_WITH_AS(
      [&] {
        for (int i = 0; i < 10; ++i) fast.advance();
      }(),
      doctest::Contains("finds no equilibrium in 3 iterations; use a step shorter than 0.002 s"), ConvergenceError);
}

}  // namespace
}  // namespace impulse
