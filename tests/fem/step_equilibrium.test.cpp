#include "fem/implicit/step_equilibrium.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

namespace impulse {
namespace {

using Eigen::VectorXd;

LinearSolver division(double by) {
  return [by](const VectorXd& b) -> VectorXd { return b / by; };
}

/// f(x) = load with f' at rest 1, from x = 0.
struct Scalar {
  std::function<double(double)> force, derivative;
  double load;

  [[nodiscard]] StepEquilibrium equilibrium(const EquilibriumOptions& options = {}) const {
    const auto tangent = derivative;
    return {{Geometry::nonlinear, division(1), [tangent](const VectorXd& x) { return division(tangent(x(0))); }},
            options,
            VectorXd::Ones(1)};
  }
  [[nodiscard]] StepEquilibrium::Step step() const {
    return {.start = VectorXd::Zero(1),
            .residual = [this](const VectorXd& x) -> VectorXd { return VectorXd::Constant(1, load - force(x(0))); },
            .follow = nullptr,
            .tangent_at = [](const VectorXd& x) -> VectorXd { return x; }};
  }
};

TEST_CASE("while the matrix at rest converges, nothing else is factorised") {
  // Each correction leaves -0.2 of the error: 1e-10 takes 15 of them.
  const Scalar soft{[](double x) { return 1.2 * x; }, [](double) { return 1.2; }, 3};
  StepEquilibrium equilibrium = soft.equilibrium();
  const auto found = equilibrium.find(soft.step());
  REQUIRE(found.has_value());
  CHECK(std::abs(found->change(0) - 2.5) <= 1e-9);
  CHECK(equilibrium.factorisation_count() == 1);
  CHECK(equilibrium.iteration_count() >= 13);
  CHECK(equilibrium.iteration_count() <= 16);
}

TEST_CASE("corrections that grow are given up at once, and the refreshed matrix is kept for the next step") {
  const Scalar stiff{[](double x) { return 2.5 * x; }, [](double) { return 2.5; }, 5};
  StepEquilibrium equilibrium = stiff.equilibrium();
  const auto found = equilibrium.find(stiff.step());
  REQUIRE(found.has_value());
  CHECK(std::abs(found->change(0) - 2) <= 1e-12);
  CHECK(equilibrium.iteration_count() == 5);  // three that grow by 1.5 each, two with the exact matrix
  CHECK(std::abs(equilibrium.response()(0) - 1 / 2.5) <= 1e-15);
  const std::size_t factorisations = equilibrium.factorisation_count();
  CHECK(equilibrium.find(stiff.step()).has_value());
  CHECK(equilibrium.factorisation_count() == factorisations);
  CHECK(equilibrium.iteration_count() <= 7);
}

TEST_CASE("Newton's iteration leaves the matrix alone where it gains digits by itself") {
  const Scalar cubic{[](double x) { return x + x * x * x; }, [](double x) { return 1 + 3 * x * x; }, 1010};
  StepEquilibrium equilibrium = cubic.equilibrium();
  const auto found = equilibrium.find(cubic.step());
  REQUIRE(found.has_value());
  CHECK(std::abs(found->change(0) - 10) <= 1e-9);
  // At least two of the last ones do without a factorisation of their own.
  CHECK(equilibrium.factorisation_count() + 2 + 3 <= 1 + equilibrium.iteration_count());
}

TEST_CASE("without a tangent, or where that fails too, there is no equilibrium") {
  const Scalar stiff{[](double x) { return 2.5 * x; }, [](double) { return 2.5; }, 5};
  StepEquilibrium blind({Geometry::nonlinear, division(1), nullptr}, {});
  CHECK_FALSE(blind.find(stiff.step()).has_value());
  CHECK(blind.factorisation_count() == 1);
  // No root: x² + 1 = 0.
  const Scalar none{[](double x) { return -x * x - 1; }, [](double x) { return -2 * x; }, 0};
  StepEquilibrium equilibrium = none.equilibrium({.tolerance = 1e-10, .most_iterations = 20});
  CHECK_FALSE(equilibrium.find(none.step()).has_value());
  CHECK_THROWS_WITH_AS((void)stiff.equilibrium({.tolerance = 0}), doctest::Contains("cannot be asked for"),
                       std::invalid_argument);
}

}  // namespace
}  // namespace impulse
