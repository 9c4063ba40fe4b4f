#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <cstddef>
#include <functional>
#include <memory>

namespace impulse {

/// What statics needs to know of an elastic body of any degree of nonlinearity. The functions must outlive the path.
struct ElasticBody {
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> internal_force;       ///< f(d) [N]
  std::function<Eigen::SparseMatrix<double>(const Eigen::VectorXd&)> tangent;  ///< ∂f/∂d, one sparsity pattern
  Eigen::SparseMatrix<double> metric;  ///< W of lengths ‖d‖ = √(dᵀWd): mass/(total mass) makes them mean displacements
};

struct NewtonOptions {
  double tolerance = 1e-9;           ///< > 0: of the last correction, ‖δd‖ relative to ‖d‖
  std::size_t most_iterations = 25;  ///< ≥ 1
};

struct PathPoint {
  double load_factor = 0;
  Eigen::VectorXd displacement;
  std::size_t iterations = 0;  ///< that it took to get there
};

/// Equilibrium f(d) = λp of a body under a dead load p, from rest on: Newton's method for (d, λ) with one more
/// condition, that of the control,
///
///   load           λ = λ*
///   displacement   cᵀd = w*        passes limit points of the load
///   arc length     ‖d - d_old‖ = s   passes limit points of the displacement (snap-back) too
///
/// Each step factorises the exact tangent in every iteration (sparse LDLᵀ, which may be indefinite) and solves for
/// residual and load together. The controls may be mixed.
/// Reference: [Crisfield1991] ch. 9. Verified by: tests/fem/equilibrium_path.test.cpp
class EquilibriumPath {
 public:
  /// @throws std::invalid_argument if sizes disagree, the load is zero, or an option is out of range.
  EquilibriumPath(const ElasticBody& body, const Eigen::VectorXd& load, const NewtonOptions& options = {});
  ~EquilibriumPath();

  /// The last point found; (0, 0) to begin with.
  [[nodiscard]] const PathPoint& point() const;

  /// One step each. @throws ConvergenceError that says where; point() is then as before.
  const PathPoint& load_to(double load_factor);
  const PathPoint& displace_to(const Eigen::VectorXd& functional, double value);

  /// One step of at most this length, shorter (halved up to ten times) where Newton's method fails or took long, onward
  /// in the direction of the step before; the first in that of growing load.
  const PathPoint& follow_arc(double longest);

 private:
  struct Condition;
  struct Work;
  bool solve(PathPoint& trial, const Condition& condition);
  std::unique_ptr<Work> work_;
};

}  // namespace impulse
