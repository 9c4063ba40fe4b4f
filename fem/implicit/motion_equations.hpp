#pragma once

#include "fem/shell/shell.hpp"
#include "lib/model/structure.hpp"
#include "lib/numerics/sparse_cholesky.hpp"

#include <Eigen/Dense>

#include <memory>

namespace impulse {

enum class Geometry { linear, nonlinear };

/// M q̈ + f(q) = load, of a whole body or of its coordinates in a basis: what implicit integration needs of it.
class MotionEquations {
 public:
  using Solver = LinearSolver;

  virtual ~MotionEquations() = default;
  [[nodiscard]] virtual Eigen::Index size() const = 0;
  [[nodiscard]] virtual Geometry geometry() const = 0;
  [[nodiscard]] virtual Eigen::VectorXd mass_times(const Eigen::VectorXd& q) const = 0;
  [[nodiscard]] virtual Eigen::VectorXd internal_force(const Eigen::VectorXd& q) const = 0;

  /// f(q + correction) with a small correction to a q where it is `force`: by K where that is cheaper.
  [[nodiscard]] virtual Eigen::VectorXd corrected_force(const Eigen::VectorXd& q, const Eigen::VectorXd& correction,
                                                        const Eigen::VectorXd& force) const = 0;
  [[nodiscard]] virtual double elastic_energy(const Eigen::VectorXd& q) const = 0;  ///< [J]

  /// r → (m M + k K)⁻¹ r, factorised once; K is the stiffness to iterate with.
  [[nodiscard]] virtual Solver solver(double m, double k) const = 0;

  /// The same with the stiffness ∂f/∂q at a displacement; empty where that isn't known or the matrix is singular.
  [[nodiscard]] virtual Solver tangent_solver(double /*m*/, double /*k*/, const Eigen::VectorXd& /*q*/) const {
    return {};
  }
};

/// A linear structure without dashpots, M and K sparse; keeps a reference to it.
[[nodiscard]] std::unique_ptr<MotionEquations> linear_equations(const Structure& body);

/// A shell with its exact internal force and the structure's K to iterate with; keeps references to both.
[[nodiscard]] std::unique_ptr<MotionEquations> shell_equations(const Shell& shell, const Structure& body);

}  // namespace impulse
