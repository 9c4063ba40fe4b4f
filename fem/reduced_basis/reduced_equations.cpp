#include "fem/reduced_basis/reduced_equations.hpp"

#include "fem/reduced_basis/wide_product.hpp"
#include "lib/contract/require.hpp"
#include "lib/numerics/dense_algebra.hpp"

namespace impulse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

class ReducedLinear : public MotionEquations {
 public:
  explicit ReducedLinear(const ReducedBasis& basis) : basis_(basis), diagonal_(basis.stiffness.isDiagonal(0)) {}
  [[nodiscard]] Index size() const override { return basis_.stiffness.rows(); }
  [[nodiscard]] Geometry geometry() const override { return Geometry::linear; }
  [[nodiscard]] VectorXd mass_times(const VectorXd& q) const override { return q; }
  [[nodiscard]] VectorXd internal_force(const VectorXd& q) const override { return stiffness_times(q); }
  [[nodiscard]] VectorXd corrected_force(const VectorXd& /*q*/, const VectorXd& correction,
                                         const VectorXd& force) const override {
    return force + stiffness_times(correction);
  }
  [[nodiscard]] double elastic_energy(const VectorXd& q) const override { return q.dot(basis_.stiffness * q) / 2; }
  [[nodiscard]] Solver solver(double m, double k) const override {
    if (diagonal_) {
      const VectorXd inverse = (m + k * basis_.stiffness.diagonal().array()).inverse();
      return [inverse](const VectorXd& r) -> VectorXd { return inverse.cwiseProduct(r); };
    }
    return dense_solver(m, k, basis_.stiffness);
  }

 protected:
  [[nodiscard]] static Solver dense_solver(double m, double k, const MatrixXd& stiffness) {
    MatrixXd matrix = k * stiffness;
    matrix.diagonal().array() += m;
    // As a product: m holds its condition down, and triangular solutions are slow at this size.
    const MatrixXd inverse = matrix.ldlt().solve(MatrixXd::Identity(matrix.rows(), matrix.cols()));
    return [inverse](const VectorXd& r) -> VectorXd {
      VectorXd x = VectorXd::Zero(r.size());
      add_product(inverse, r, x);
      return x;
    };
  }

  [[nodiscard]] VectorXd stiffness_times(const VectorXd& q) const {
    if (diagonal_) return basis_.stiffness.diagonal().cwiseProduct(q);
    VectorXd force = VectorXd::Zero(q.size());
    add_product(basis_.stiffness, q, force);
    return force;
  }

  const ReducedBasis& basis_;
  bool diagonal_;
};

class Projected : public ReducedLinear {
 public:
  Projected(const Shell& shell, const ReducedBasis& basis) : ReducedLinear(basis), shell_(shell) {}
  [[nodiscard]] Geometry geometry() const override { return Geometry::nonlinear; }
  [[nodiscard]] VectorXd internal_force(const VectorXd& q) const override {
    return basis_.vectors.transpose() * shell_.internal(basis_.vectors * q).force;
  }
  [[nodiscard]] double elastic_energy(const VectorXd& q) const override {
    return shell_.internal(basis_.vectors * q).energy_J;
  }
  [[nodiscard]] Solver tangent_solver(double m, double k, const VectorXd& q) const override {
    return dense_solver(m, k, basis_.vectors.transpose() * (shell_.tangent(basis_.vectors * q) * basis_.vectors));
  }

 private:
  const Shell& shell_;
};

class Tensors : public ReducedLinear {
 public:
  explicit Tensors(const TensorModel& model)
      : ReducedLinear(model.basis),
        model_(model),
        beside_(model.basis.stiffness),
        companion_transposed_(model.companion.transpose()) {
    beside_.topLeftCorner(model.energy.size(), model.energy.size()).setZero();
  }
  [[nodiscard]] Geometry geometry() const override { return Geometry::nonlinear; }
  [[nodiscard]] VectorXd internal_force(const VectorXd& q) const override {
    const Index n = model_.energy.size();
    const VectorXd z = q.head(n), y = q.tail(q.size() - n), pairs = pair_products(z);
    VectorXd force = VectorXd::Zero(q.size());
    force.head(n) = model_.energy.force(z, pairs);
    add_product(beside_, q, force);
    add_product(model_.companion, pairs, force.tail(y.size()));
    // ∂(gᵀp)/∂z for g = companionᵀ y.
    VectorXd g = VectorXd::Zero(pairs.size());
    add_product(companion_transposed_, y, g);
    for (Index k = 0, at = 0; k < n; at += ++k) {
      force(k) += g.segment(at, k + 1).dot(z.head(k + 1));
      force.head(k + 1) += z(k) * g.segment(at, k + 1);
    }
    return force;
  }
  [[nodiscard]] double elastic_energy(const VectorXd& q) const override {
    const Index n = model_.energy.size();
    const VectorXd z = q.head(n), y = q.tail(q.size() - n);
    return model_.energy.energy(z) + q.dot(beside_ * q) / 2 + y.dot(model_.companion * pair_products(z));
  }
  [[nodiscard]] Solver tangent_solver(double m, double k, const VectorXd& q) const override {
    const Index n = model_.energy.size(), others = q.size() - n;
    const VectorXd z = q.head(n);
    const MatrixXd pairs = pair_derivatives(z);
    MatrixXd tangent = beside_;  // its lower triangle, which LDLᵀ reads
    tangent.topLeftCorner(n, n) += model_.energy.tangent(z);
    tangent.bottomLeftCorner(others, n) += model_.companion * pairs;
    const VectorXd g = companion_transposed_ * q.tail(others);
    for (Index c = 0, at = 0; c < n; ++c)
      for (Index r = 0; r <= c; ++r, ++at) {
        tangent(r, c) += g(at);
        tangent(c, r) += g(at);
      }
    return dense_solver(m, k, tangent);
  }

 private:
  const TensorModel& model_;
  MatrixXd beside_;  // the stiffness but for that of z, which the energy has
  MatrixXd companion_transposed_;
};

/// The largest nodal displacement of a unit coordinate.
double largest_displacement(const Shell& shell, const VectorXd& vector) {
  const VectorXd values = shell.nodal_values(vector);
  double largest = 0;
  for (Index i = 0; i < values.size(); i += 4) largest = std::max(largest, std::abs(values(i)));
  return largest;
}

}  // namespace

std::unique_ptr<MotionEquations> linear_equations(const ReducedBasis& basis) {
  return std::make_unique<ReducedLinear>(basis);
}

std::unique_ptr<MotionEquations> projected_equations(const Shell& shell, const ReducedBasis& basis) {
  return std::make_unique<Projected>(shell, basis);
}

std::unique_ptr<MotionEquations> tensor_equations(const TensorModel& model) { return std::make_unique<Tensors>(model); }

TensorModel tensor_model(const Shell& shell, const Structure& body, const SparseCholesky& factor,
                         const ReducedBasis& basis, std::size_t nonlinear_count) {
  const auto n = static_cast<Index>(nonlinear_count);
  require(n >= 1 && n <= basis.vectors.cols(), "{} nonlinear vectors of {}; ask for no more than there are", n,
          basis.vectors.cols());
  const MatrixXd finite = basis.vectors.leftCols(n);
  VectorXd amplitude(n);
  for (Index k = 0; k < n; ++k)
    amplitude(k) = shell.panel().laminate.thickness_m / largest_displacement(shell, finite.col(k));
  QuarticReduction reduction =
      quartic_reduction([&](const VectorXd& q) { return shell.internal(q).force; }, body.stiffness, finite, amplitude);
  const MatrixXd& force = reduction.quadratic_force;
  MatrixXd seen = MatrixXd::Zero(basis.vectors.cols(), force.cols());
  add_transposed_product(basis.vectors, force, seen);
  TensorModel model{basis, std::move(reduction.energy), seen.bottomRows(seen.rows() - n), {}};
  model.slaved = basis.vectors * basis.stiffness.ldlt().solve(seen) - factor.solve(force);
  MatrixXd g = MatrixXd::Zero(force.cols(), force.cols());
  add_transposed_product(force, model.slaved, g);
  condense(model.energy, -(g + g.transpose()) / 2);
  return model;
}

VectorXd expanded(const TensorModel& model, const VectorXd& coordinates) {
  return model.basis.vectors * coordinates + model.slaved * pair_products(coordinates.head(model.energy.size()));
}

}  // namespace impulse
