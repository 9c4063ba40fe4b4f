#include "fem/implicit/newmark.hpp"

#include "fem/bodies/bar_structure.hpp"
#include "lib/contract/errors.hpp"
#include "tests/support/about.hpp"
#include "tests/support/oscillator.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace impulse {
namespace {

using test::oscillator;

const Eigen::VectorXd one = Eigen::VectorXd::Ones(1), none = Eigen::VectorXd::Zero(1);

Structure rod(std::size_t elements) {
  const Bar bar{{parse_segment("0.5m,10mm,steel")}, {Face::a}, FarEnd::free};
  return bar_structure(bar, bar_mesh_by_count(bar, elements, MassMatrix::consistent));
}

TEST_CASE("a free oscillation is that of the rule: period longer by (ωΔt)²/12, no decay") {
  const double omega = 2 * std::numbers::pi, dt = 0.05;
  Newmark newmark(oscillator(omega * omega, 1), dt);
  MotionState state{one, none, none};
  newmark.set_load(state, none);
  CHECK(state.acceleration(0) == about(-omega * omega).epsilon(1e-14));
  // The rule turns the phase by 2 atan(ωΔt/2) a step, exactly.
  const double turn = 2 * std::atan(omega * dt / 2);
  for (int n = 1; n <= 400; ++n) {
    CHECK(newmark.advance(state, none) == 1);
    CHECK(std::abs(state.displacement(0) - std::cos(n * turn)) <= 1e-15 * 20 * n);
  }
  CHECK(omega * dt / turn == about(1 + std::pow(omega * dt, 2) / 12).epsilon(1e-4));
}

TEST_CASE("a damped, driven oscillation converges with order 2") {
  // ü + 2ζω u̇ + ω²u = 1 from rest.
  const double omega = 5, zeta = 0.1, end = 2, damped = omega * std::sqrt(1 - zeta * zeta);
  const double exact =
      (1 - std::exp(-zeta * omega * end) * (std::cos(damped * end) + zeta * omega / damped * std::sin(damped * end))) /
      (omega * omega);
  std::vector<double> error;
  for (const int steps : {50, 100, 200, 400}) {
    Newmark newmark(oscillator(omega * omega, 1, 2 * zeta * omega), end / steps);
    MotionState state = MotionState::at_rest(1);
    newmark.set_load(state, one);
    for (int n = 0; n < steps; ++n) (void)newmark.advance(state, one);
    error.push_back(std::abs(state.displacement(0) - exact));
  }
  for (std::size_t i = 0; i + 1 < error.size(); ++i)
    CHECK(std::log2(error[i] / error[i + 1]) == about(2).epsilon(0.05));
  CHECK(error.back() > 1e-9);
}

TEST_CASE("a free body keeps its momentum, and its energy is the work done on it") {
  const Structure body = rod(50);
  const double dt = 3e-6;  // 1.5 times the explicit limit
  Newmark newmark(body, dt);
  MotionState state = MotionState::at_rest(51);
  const Eigen::VectorXd contact = body.contacts.col(0);
  newmark.set_load(state, none.replicate(51, 1));
  double impulse = 0, work = 0, before = 0;
  for (int n = 1; n <= 300; ++n) {
    const double force = n < 40 ? std::sin(std::numbers::pi * n / 40) : 0;
    const double at = contact.dot(state.displacement);
    (void)newmark.advance(state, force * contact);
    impulse += 0.5 * dt * (before + force);
    work += 0.5 * (before + force) * (contact.dot(state.displacement) - at);
    before = force;
  }
  const double momentum = (body.mass * state.velocity).sum();
  CHECK(momentum == about(impulse).epsilon(1e-11));
  const double energy = 0.5 * state.velocity.dot(body.mass * state.velocity) +
                        0.5 * state.displacement.dot(body.stiffness * state.displacement);
  CHECK(energy == about(work).epsilon(1e-11));
}

TEST_CASE("a nonlinear spring: equilibrium at the end of each step, order 2, and the linear force needs no more") {
  // ü + u + u³ = 0: energy ½u̇² + ½u² + ¼u⁴. Reference by Richardson extrapolation of the two finest.
  const InternalForce cubic = [](const Eigen::VectorXd& d, Eigen::VectorXd& f) { f = d.array() + d.array().cube(); };
  std::vector<double> end;
  for (const int steps : {40, 80, 160, 320, 640}) {
    Newmark newmark(oscillator(1, 1), cubic, 3.0 / steps);
    MotionState state{2 * one, none, none};
    newmark.set_load(state, none);
    CHECK(state.acceleration(0) == about(-10));
    for (int n = 0; n < steps; ++n) {
      CHECK(newmark.advance(state, none) <= 20);
      const double u = state.displacement(0);
      CHECK(std::abs(state.acceleration(0) + u + u * u * u) <= 1e-5);  // (4/Δt²)·1e-10 of the change of u
    }
    end.push_back(state.displacement(0));
  }
  const double limit = end[4] + (end[4] - end[3]) / 3;
  for (std::size_t i = 0; i + 2 < end.size(); ++i)
    CHECK(std::log2((end[i] - limit) / (end[i + 1] - limit)) == about(2).epsilon(0.05));

  const Structure body = rod(10);
  Newmark linear(body, 1e-6), hooked(body, linear_internal_force(body.stiffness), 1e-6);
  MotionState a = MotionState::at_rest(11), b = a;
  for (int n = 0; n < 20; ++n) {
    (void)linear.advance(a, body.contacts.col(0));
    CHECK(hooked.advance(b, body.contacts.col(0)) == 2);  // the second finds nothing left
  }
  CHECK((a.displacement - b.displacement).norm() <= 1e-12 * a.displacement.norm());
}

TEST_CASE("an equilibrium that is not found is an error, and leaves the state alone") {
  // Far stiffer than the matrix it is iterated with.
  const InternalForce stiff = [](const Eigen::VectorXd& d, Eigen::VectorXd& f) { f = 1e9 * d; };
  Newmark newmark(oscillator(1, 1), stiff, 1);
  MotionState state{one, none, none};
  CHECK_THROWS_WITH_AS(newmark.advance(state, none),
                       "a step of 1 s finds no equilibrium in 50 iterations; use a shorter step", ConvergenceError);
  CHECK(state.displacement == one);
}

TEST_CASE("what cannot be integrated is refused") {
  CHECK_THROWS_WITH(Newmark(rod(4), 0.0), "step 0 s is not positive");
  CHECK_THROWS_WITH(Newmark(oscillator(-9, 1), 1.0), doctest::Contains("is not positive definite"));
  CHECK_THROWS_WITH(Newmark(oscillator(1, 1), nullptr, 1.0, {0, 1}), doctest::Contains("cannot be asked for"));
  Structure body = oscillator(1, 1);
  body.dashpots = Eigen::VectorXd::Ones(3);
  CHECK_THROWS_WITH(Newmark(body, 1.0), "3 dashpots for 1 degrees of freedom");
}

}  // namespace
}  // namespace impulse
