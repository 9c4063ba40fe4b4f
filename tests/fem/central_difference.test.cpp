#include "fem/explicit/central_difference.hpp"

#include "fem/bodies/bar_structure.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"
#include "tests/support/oscillator.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <random>
#include <stdexcept>

namespace impulse {
namespace {

using test::oscillator;

double highest_frequency(const Structure& body) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(Eigen::MatrixXd(body.stiffness),
                                                                         Eigen::MatrixXd(body.mass));
  return std::sqrt(solver.eigenvalues().maxCoeff());
}

TEST_CASE("an oscillator turns by the discrete angle, sin(θ/2) = ωΔt/2") {
  const double step = 0.3;
  CentralDifference stepper(oscillator(4, 1), step);
  MotionState state = MotionState::at_rest(1);
  state.displacement[0] = 1;
  const Eigen::VectorXd contact = Eigen::VectorXd::Ones(1);
  stepper.set_load(state, 0 * contact);
  for (int n = 1; n <= 50; ++n) {
    stepper.advance(state, 0 * contact);
    CHECK(std::abs(state.displacement[0] - std::cos(n * 2 * std::asin(2 * step / 2))) < 1e-13);
  }
}

TEST_CASE("a damped, driven oscillator converges with order 2 in displacement and velocity") {
  // m ü + c u̇ + k u = cos t with the start of the steady answer u = Re(X e^{it}), X = 1/(k - m + ic).
  const double k = 5, m = 1, c = 0.7;
  const double re = (k - m) / ((k - m) * (k - m) + c * c), im = -c / ((k - m) * (k - m) + c * c);
  const Eigen::VectorXd contact = Eigen::VectorXd::Ones(1);
  std::vector<double> errors;
  for (const int steps : {40, 80, 160, 320}) {
    const double step = 4.0 / steps;
    CentralDifference stepper(oscillator(k, m, c), step);
    MotionState state = MotionState::at_rest(1);
    state.displacement[0] = re;
    state.velocity[0] = -im;
    stepper.set_load(state, 1 * contact);
    for (int n = 1; n <= steps; ++n) stepper.advance(state, std::cos(n * step) * contact);
    const double u = re * std::cos(4.0) - im * std::sin(4.0), v = -re * std::sin(4.0) - im * std::cos(4.0);
    errors.push_back(std::hypot(state.displacement[0] - u, state.velocity[0] - v));
  }
  for (std::size_t i = 1; i < errors.size(); ++i) CHECK(std::log2(errors[i - 1] / errors[i]) == about(2).epsilon(0.05));
}

TEST_CASE(
    "at Courant number 1 a cylinder under a step force moves as d'Alembert says, at every node for five transits") {
  const Bar bar = bars::steel_rod(0.5);
  const int n = 40;
  const double transit = travel_time_s(bar.profile), step = transit / n;
  const Structure body = bar_structure(bar, bar_mesh_by_count(bar, n));
  CentralDifference stepper(body, step);
  MotionState state = MotionState::at_rest(n + 1);
  const double impedance = face_impedance_kg_per_s(bar.profile, Face::a), force = 1000;
  const Eigen::VectorXd contact = body.contacts.col(0);
  stepper.set_load(state, force * contact);
  double worst = 0;
  for (int k = 1; k <= 5 * n; ++k) {
    stepper.advance(state, force * contact);
    for (int j = 0; j <= n; ++j) {
      // In steps: the direct wave and its reflections between the free ends.
      double lags = std::max(0, k - j);
      for (int r = 1; 2 * r * n - j <= k; ++r) lags += std::max(0, k - 2 * r * n + j) + std::max(0, k - 2 * r * n - j);
      worst = std::max(worst, std::abs(state.displacement[j] - force / impedance * step * lags));
    }
  }
  CHECK(worst <= 1e-12 * force / impedance * transit);
}

TEST_CASE("at Courant number 1 a pulse of ψ = D·u runs through a cone unchanged, away from its ends") {
  const Bar bar = bars::cone();
  const int n = 200, middle = 100, travelled = 60;
  const Structure body = bar_structure(bar, bar_mesh_by_count(bar, n));
  CentralDifference stepper(body, travel_time_s(bar.profile) / n);
  std::mt19937 engine(17);
  std::uniform_real_distribution<double> value(-1, 1);
  Eigen::VectorXd psi = Eigen::VectorXd::Zero(n + 1);
  for (int j = middle - 10; j <= middle + 10; ++j) psi[j] = value(engine);
  const auto diameter = [](int j) { return 0.030 + 0.045 * j / double(n); };
  MotionState state = MotionState::at_rest(n + 1);
  for (int j = 0; j <= n; ++j) state.displacement[j] = psi[j] / diameter(j);
  stepper.set_load(state, 0 * body.contacts.col(0));
  for (int k = 0; k < travelled; ++k) stepper.advance(state, 0 * body.contacts.col(0));
  for (int j = travelled; j <= n - travelled; ++j)
    CHECK(std::abs(state.displacement[j] * diameter(j) - 0.5 * (psi[j - travelled] + psi[j + travelled])) <= 1e-11);
}

TEST_CASE("an infinite end sends no echo at Courant number 1, and only a faint one below") {
  const Bar bar = bars::steel_rod(0.5, FarEnd::infinite);
  const double admittance = 1 / face_impedance_kg_per_s(bar.profile, Face::a);
  const auto worst_echo = [&](double courant) {
    const Structure body = bar_structure(bar, bar_mesh_by_count(bar, 50));
    CentralDifference stepper(body, courant * travel_time_s(bar.profile) / 50);
    MotionState state = MotionState::at_rest(51);
    stepper.set_load(state, 0 * body.contacts.col(0));
    double worst = 0;
    // A raised cosine over 50 steps, then nothing.
    for (int k = 1; k <= 400; ++k) {
      const double force = k < 50 ? 0.5 - 0.5 * std::cos(2 * M_PI * k / 50) : 0;
      stepper.advance(state, force * body.contacts.col(0));
      if (k > 90) worst = std::max(worst, std::abs(state.velocity[0]));
    }
    return worst / admittance;
  };
  CHECK(worst_echo(1) <= 1e-12);
  CHECK(worst_echo(0.8) <= 1e-3);
}

TEST_CASE("the sparse product and the product by three diagonals are those of the matrix") {
  const Bar bar = bars::composite();
  Eigen::SparseMatrix<double> k = bar_structure(bar, bar_mesh_by_count(bar, 30)).stiffness;
  const Eigen::VectorXd d = Eigen::VectorXd::LinSpaced(31, -1, 2).array().cube();
  for (int corner = 0; corner < 2; ++corner) {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(31);
    linear_internal_force(k)(d, f);
    const Eigen::VectorXd expected = Eigen::MatrixXd(k) * d;
    CHECK((f - expected).norm() <= 1e-15 * k.norm() * d.norm());
    k.coeffRef(0, 30) = k.coeffRef(30, 0) = 1e9;  // no longer tridiagonal
  }
}

TEST_CASE("the stability limit of a free uniform rod is h/c to rounding") {
  for (const std::size_t n : {1u, 2u, 17u, 500u}) {
    const Bar bar = bars::steel_rod(0.5);
    const double limit = stability_limit_s(bar_structure(bar, {{n}, MassMatrix::lumped}));
    const double courant_1 = travel_time_s(bar.profile) / static_cast<double>(n);
    CHECK(std::abs(limit / courant_1 - 1) <= 1e-12);
    CHECK_NOTHROW(require_stable_step(bar_structure(bar, {{n}, MassMatrix::lumped}), courant_1, "target"));
  }
}

TEST_CASE("the stability limit is 2/ω of the highest mode, on the safe side, for any chain, support and mass matrix") {
  for (const MassMatrix mass : {MassMatrix::lumped, MassMatrix::consistent})
    for (const FarEnd far_end : {FarEnd::free, FarEnd::fixed})
      for (const Bar& rod : {bars::cone(Face::b), bars::composite()}) {
        const Bar bar{rod.profile, rod.faces, far_end};
        const Structure body = bar_structure(bar, bar_mesh_by_count(bar, 37, mass));
        CHECK(std::abs(stability_limit_s(body) * highest_frequency(body) / 2 - 1) <= 1e-11);
      }
  CHECK(stability_limit_s(oscillator(9, 4)) == about(4.0 / 3).epsilon(1e-12));
}

TEST_CASE("the limit is where motion starts to grow") {
  const Bar bar = bars::cone();
  const Structure body = bar_structure(bar, bar_mesh_by_count(bar, 20));
  const double limit = stability_limit_s(body);
  const auto largest = [&](double step) {
    CentralDifference stepper(body, step);
    MotionState state = MotionState::at_rest(21);
    stepper.set_load(state, 1 * body.contacts.col(0));
    for (int k = 0; k < 3000; ++k) stepper.advance(state, 0 * body.contacts.col(0));
    return state.velocity.cwiseAbs().maxCoeff();
  };
  const double calm = largest(limit * 0.999);
  CHECK(calm < 1);
  CHECK(largest(limit * 1.001) > 1e6 * calm);
}

TEST_CASE("an unstable step is refused with the limit and a step that works") {
  const Bar rod = bars::long_rod();
  const Structure body = bar_structure(rod, bar_mesh_by_count(rod, 30));
  CHECK_THROWS_WITH_AS(require_stable_step(body, 41e-6, "target"),
                       "step 41 us exceeds the stability limit 39.84 us of the target; use --step 39.8us",
                       std::invalid_argument);
  CHECK_NOTHROW(require_stable_step(body, 39.8e-6, "target"));
}

TEST_CASE("with consistent mass every mode turns by its discrete angle, and dashpots act on the new velocity") {
  const Bar bar = bars::composite();
  const Structure body = bar_structure(bar, bar_mesh_by_count(bar, 12, MassMatrix::consistent));
  const Eigen::MatrixXd k(body.stiffness), m(body.mass);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(k, m);
  const double step = 0.9 * stability_limit_s(body);
  for (const Eigen::Index i : {1, 5, 12}) {
    CentralDifference stepper(body, step);
    MotionState state = MotionState::at_rest(m.rows());
    state.displacement = modes.eigenvectors().col(i);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(m.rows());
    stepper.set_load(state, none);
    for (int n = 0; n < 100; ++n) stepper.advance(state, none);
    const double angle = 2 * std::asin(0.5 * step * std::sqrt(modes.eigenvalues()[i]));
    const Eigen::VectorXd expected = std::cos(100 * angle) * modes.eigenvectors().col(i);
    CHECK((state.displacement - expected).norm() <= 1e-10 * modes.eigenvectors().col(i).norm());
  }
  // A step with dashpots against the equation itself.
  Structure damped = body;
  damped.dashpots = Eigen::VectorXd::LinSpaced(m.rows(), 0, 2 * m.diagonal().maxCoeff() / step);
  CentralDifference stepper(damped, step);
  MotionState state = MotionState::at_rest(m.rows());
  state.velocity = modes.eigenvectors().col(3);
  const Eigen::VectorXd load = 1e3 * Eigen::VectorXd::Ones(m.rows());
  stepper.set_load(state, load);
  stepper.advance(state, load);
  const Eigen::VectorXd unbalanced = load - k * state.displacement - damped.dashpots.cwiseProduct(state.velocity);
  CHECK((m * state.acceleration - unbalanced).norm() <= 1e-12 * (k * state.displacement).norm());
}

TEST_CASE("bodies that cannot be integrated explicitly are refused") {
  CHECK_THROWS_WITH_AS((void)CentralDifference(oscillator(1, 1), 0), "step 0 s is not positive", std::invalid_argument);
  CHECK_THROWS_WITH_AS(CentralDifference(oscillator(1, -2), 1), "mass -2 kg of degree of freedom 0 is not positive",
                       std::invalid_argument);
  CHECK(std::isinf(stability_limit_s(oscillator(0, 1))));
  Eigen::SparseMatrix<double> identity(2, 2);
  identity.setIdentity();
  CHECK_THROWS_WITH_AS(CentralDifference(identity, Eigen::VectorXd::Ones(3), {}, 1.0),
                       "3 dashpots for 2 degrees of freedom", std::invalid_argument);
  Eigen::SparseMatrix<double> indefinite = identity;
  indefinite.coeffRef(0, 1) = indefinite.coeffRef(1, 0) = 2;
  CHECK_THROWS_WITH_AS(CentralDifference(indefinite, {}, {}, 1.0), "the mass matrix is not positive definite",
                       std::invalid_argument);
}

}  // namespace
}  // namespace impulse
