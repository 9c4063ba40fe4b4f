#pragma once

#include "fem/implicit/motion_equations.hpp"

#include <Eigen/Dense>

#include <cstddef>
#include <functional>
#include <optional>

namespace impulse {

/// When the equilibrium of a nonlinear step is found.
struct EquilibriumOptions {
  double tolerance = 1e-10;          ///< > 0: error of the change of displacement, relative to it
  std::size_t most_iterations = 50;  ///< ≥ 1: with one matrix, and once more with refreshed ones
};

/// The matrix A = -∂r/∂x of a step, such as ½K + 2M/Δt², by its solutions b → A⁻¹b.
struct StepMatrix {
  Geometry geometry = Geometry::linear;
  LinearSolver at_rest;
  /// With the tangent stiffness at these coordinates; empty, or giving an empty one, where there is none.
  std::function<LinearSolver(const Eigen::VectorXd& coordinates)> tangent;
};

/// The equilibrium of an implicit step, whatever the rule: the change x of the coordinates with r(x) = 0. Each
/// correction is A⁻¹r with
///
///   A at rest     factorised once, as long as that converges (modified Newton);
///   A at x        where it doesn't: if corrections grow twice in a row or the iterations run out, the step begins
///                 anew with this one, factorised again after every correction that left more than 0.3 of the one
///                 before (Newton). The last one is kept for the steps that follow.
///
/// Iteration ends when the next correction, as the slowest rate of the last iterations foretells it, is below the
/// tolerance; linear equations take one solution.
/// Verified by: tests/fem/step_equilibrium.test.cpp, tests/fem/implicit_impact.test.cpp
class StepEquilibrium {
 public:
  /// `load`: a vector whose response A⁻¹load goes with every factorisation; may be empty.
  /// @throws std::invalid_argument for options out of range.
  StepEquilibrium(StepMatrix matrix, const EquilibriumOptions& options, const Eigen::VectorXd& load = {});

  struct Step {
    Eigen::VectorXd start;  ///< of the change
    std::function<Eigen::VectorXd(const Eigen::VectorXd& change)> residual;
    /// Adds to a correction what a load that depends on the displacement makes of it; may be empty.
    std::function<void(const Eigen::VectorXd& change, Eigen::VectorXd& correction)> follow;
    std::function<Eigen::VectorXd(const Eigen::VectorXd& change)> tangent_at;  ///< coordinates for A
  };

  struct Found {
    Eigen::VectorXd change;
    Eigen::VectorXd last_correction;  ///< in the change; the residual was evaluated without it
  };

  /// Nothing if both iterations fail.
  [[nodiscard]] std::optional<Found> find(const Step& step);

  [[nodiscard]] const Eigen::VectorXd& response() const { return response_; }  ///< A⁻¹load
  [[nodiscard]] std::size_t iteration_count() const { return iterations_; }    ///< of all steps so far
  [[nodiscard]] std::size_t factorisation_count() const { return factorisations_; }
  [[nodiscard]] double last_correction() const { return last_correction_; }  ///< relative to the change

 private:
  enum class Iteration { modified, newton };
  [[nodiscard]] std::optional<Found> iterate(const Step& step, Iteration kind);
  [[nodiscard]] bool refresh(const Eigen::VectorXd& at);
  [[nodiscard]] bool settled(double relative);

  StepMatrix matrix_;
  EquilibriumOptions options_;
  LinearSolver solve_;
  Eigen::VectorXd load_, response_;
  double rate_ = 1;             // of convergence, as last seen
  double last_correction_ = 0;  // relative, of the iteration before
  std::size_t iterations_ = 0, factorisations_ = 1;
};

}  // namespace impulse
