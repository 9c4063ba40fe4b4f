#include "fem/implicit/motion_equations.hpp"

#include "lib/contract/require.hpp"
#include "lib/numerics/sparse_cholesky.hpp"

namespace impulse {
namespace {

using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

class LinearEquations : public MotionEquations {
 public:
  explicit LinearEquations(const Structure& body) : body_(body) {
    require(body.dashpots.size() == 0 || body.dashpots.isZero(0), "implicit impact takes no dashpots");
  }
  [[nodiscard]] Eigen::Index size() const override { return body_.mass.rows(); }
  [[nodiscard]] Geometry geometry() const override { return Geometry::linear; }
  [[nodiscard]] VectorXd mass_times(const VectorXd& q) const override { return body_.mass * q; }
  [[nodiscard]] VectorXd internal_force(const VectorXd& q) const override { return body_.stiffness * q; }
  [[nodiscard]] VectorXd corrected_force(const VectorXd& q, const VectorXd& correction,
                                         const VectorXd& /*force*/) const override {
    return internal_force(q + correction);
  }
  [[nodiscard]] double elastic_energy(const VectorXd& q) const override { return q.dot(body_.stiffness * q) / 2; }
  [[nodiscard]] Solver solver(double m, double k) const override {
    auto found = SparseCholesky::of(Sparse(m * body_.mass + k * body_.stiffness));
    require(found.has_value(), "the matrix of a step is not positive definite");
    const auto factor = std::make_shared<SparseCholesky>(std::move(*found));
    return [factor](const VectorXd& r) { return factor->solve(r); };
  }

 protected:
  const Structure& body_;
};

class ShellEquations : public LinearEquations {
 public:
  ShellEquations(const Shell& shell, const Structure& body) : LinearEquations(body), shell_(shell) {}
  [[nodiscard]] Geometry geometry() const override { return Geometry::nonlinear; }
  [[nodiscard]] VectorXd internal_force(const VectorXd& q) const override { return shell_.internal(q).force; }
  [[nodiscard]] double elastic_energy(const VectorXd& q) const override { return shell_.internal(q).energy_J; }
  [[nodiscard]] Solver tangent_solver(double m, double k, const VectorXd& q) const override {
    return symmetric_solver(m * body_.mass + k * shell_.tangent(q));
  }

 private:
  const Shell& shell_;
};

}  // namespace

std::unique_ptr<MotionEquations> linear_equations(const Structure& body) {
  return std::make_unique<LinearEquations>(body);
}

std::unique_ptr<MotionEquations> shell_equations(const Shell& shell, const Structure& body) {
  return std::make_unique<ShellEquations>(shell, body);
}

}  // namespace impulse
