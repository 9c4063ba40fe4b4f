#include "fem/reduced_basis/reduced_equations.hpp"

#include "fem/reduced_basis/wide_product.hpp"
#include "lib/contract/require.hpp"

#include <Eigen/SparseCholesky>

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
    MatrixXd matrix = k * basis_.stiffness;
    matrix.diagonal().array() += m;
    const auto factor = std::make_shared<Eigen::LDLT<MatrixXd>>(matrix);
    return [factor](const VectorXd& r) -> VectorXd { return factor->solve(r); };
  }

 protected:
  [[nodiscard]] VectorXd stiffness_times(const VectorXd& q) const {
    if (diagonal_) return basis_.stiffness.diagonal().cwiseProduct(q);
    return basis_.stiffness * q;
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

 private:
  const Shell& shell_;
};

class Tensors : public ReducedLinear {
 public:
  explicit Tensors(const TensorModel& model)
      : ReducedLinear(model.modes),
        model_(model),
        own_(model.modes.stiffness.diagonal().tail(model.companion.rows())),
        companion_transposed_(model.companion.transpose()) {}
  [[nodiscard]] Geometry geometry() const override { return Geometry::nonlinear; }
  [[nodiscard]] VectorXd internal_force(const VectorXd& q) const override {
    const Index n = model_.energy.size();
    const VectorXd z = q.head(n), y = q.tail(q.size() - n), pairs = pair_products(z);
    VectorXd force(q.size());
    force.head(n) = model_.energy.force(z, pairs);
    force.tail(y.size()) = own_.cwiseProduct(y);
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
    return model_.energy.energy(z) + y.dot(own_.cwiseProduct(y)) / 2 + y.dot(model_.companion * pair_products(z));
  }

 private:
  const TensorModel& model_;
  VectorXd own_;
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

TensorModel tensor_model(const Shell& shell, const Structure& body, const ReducedBasis& modes,
                         std::size_t nonlinear_count) {
  const auto n = static_cast<Index>(nonlinear_count);
  require(n >= 1 && n <= modes.vectors.cols(), "{} nonlinear modes of {}; ask for no more than there are", n,
          modes.vectors.cols());
  const MatrixXd finite = modes.vectors.leftCols(n);
  VectorXd amplitude(n);
  for (Index k = 0; k < n; ++k)
    amplitude(k) = shell.panel().laminate.thickness_m / largest_displacement(shell, finite.col(k));
  QuarticReduction reduction =
      quartic_reduction([&](const VectorXd& q) { return shell.internal(q).force; }, body.stiffness, finite, amplitude);
  TensorModel model{modes, std::move(reduction.energy), {}, {}};
  const MatrixXd& force = reduction.quadratic_force;
  model.companion = modes.vectors.rightCols(modes.vectors.cols() - n).transpose() * force;
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor(body.stiffness);
  require(factor.info() == Eigen::Success, "the stiffness matrix cannot be factorised; hold the panel at its edges");
  const MatrixXd statically = factor.solve(force);
  const MatrixXd dynamic = modes.stiffness.diagonal().cwiseInverse().asDiagonal() * (modes.vectors.transpose() * force);
  model.slaved = modes.vectors * dynamic - statically;
  const MatrixXd g = -force.transpose() * model.slaved;
  condense(model.energy, (g + g.transpose()) / 2);
  return model;
}

VectorXd expanded(const TensorModel& model, const VectorXd& coordinates) {
  return model.modes.vectors * coordinates + model.slaved * pair_products(coordinates.head(model.energy.size()));
}

}  // namespace impulse
