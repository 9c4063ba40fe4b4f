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

/// K is an arrow: full in z, diagonal in y, which costs 1,300 multiplications for 12 and 48 coordinates and not 3,600.
class Tensors : public ReducedLinear {
 public:
  explicit Tensors(const TensorModel& model)
      : ReducedLinear(model.basis),
        model_(model),
        n_(model.energy.size()),
        others_(model.basis.stiffness.rows() - n_),
        zz_(model.basis.stiffness.topLeftCorner(n_, n_)),
        zy_(model.basis.stiffness.topRightCorner(n_, others_)),
        yz_(model.basis.stiffness.bottomLeftCorner(others_, n_)),
        yy_(model.basis.stiffness.diagonal().tail(others_)),
        companion_transposed_(model.companion.transpose()) {}
  [[nodiscard]] Geometry geometry() const override { return Geometry::nonlinear; }
  [[nodiscard]] VectorXd internal_force(const VectorXd& q) const override {
    const VectorXd z = q.head(n_), y = q.tail(others_), pairs = pair_products(z);
    VectorXd force(q.size());
    force.head(n_) = model_.energy.force(z, pairs);
    force.tail(others_) = yy_.cwiseProduct(y);
    add_coupling(z, y, force);
    add_product(model_.companion, pairs, force.tail(others_));
    // ∂(gᵀp)/∂z for g = companionᵀ y.
    VectorXd g = VectorXd::Zero(pairs.size());
    add_product(companion_transposed_, y, g);
    for (Index k = 0, at = 0; k < n_; at += ++k) {
      force(k) += g.segment(at, k + 1).dot(z.head(k + 1));
      force.head(k + 1) += z(k) * g.segment(at, k + 1);
    }
    return force;
  }
  [[nodiscard]] VectorXd corrected_force(const VectorXd& /*q*/, const VectorXd& correction,
                                         const VectorXd& force) const override {
    const VectorXd z = correction.head(n_), y = correction.tail(others_);
    VectorXd corrected = force;
    add_product(zz_, z, corrected.head(n_));
    corrected.tail(others_) += yy_.cwiseProduct(y);
    add_coupling(z, y, corrected);
    return corrected;
  }
  [[nodiscard]] double elastic_energy(const VectorXd& q) const override {
    const VectorXd z = q.head(n_), y = q.tail(others_);
    return model_.energy.energy(z) + y.dot(yz_ * z + model_.companion * pair_products(z)) +
           y.dot(yy_.cwiseProduct(y)) / 2;
  }
  [[nodiscard]] Solver solver(double m, double k) const override {
    const VectorXd inverse = (m + k * yy_.array()).inverse();
    const MatrixXd down = -k * (inverse.asDiagonal() * yz_), across = down.transpose();
    MatrixXd schur = k * (zz_ + zy_ * down);
    schur.diagonal().array() += m;
    const MatrixXd inverse_schur = schur.ldlt().solve(MatrixXd::Identity(n_, n_));
    return [this, inverse, down, across, inverse_schur](const VectorXd& r) -> VectorXd {
      VectorXd rz = r.head(n_);
      add_product(across, r.tail(others_), rz);
      VectorXd z = VectorXd::Zero(n_), x(r.size());
      add_product(inverse_schur, rz, z);
      x.head(n_) = z;
      x.tail(others_) = inverse.cwiseProduct(r.tail(others_));
      add_product(down, z, x.tail(others_));
      return x;
    };
  }
  [[nodiscard]] Solver tangent_solver(double m, double k, const VectorXd& q) const override {
    const VectorXd z = q.head(n_);
    const MatrixXd pairs = pair_derivatives(z);
    MatrixXd tangent = model_.basis.stiffness;  // its lower triangle, which LDLᵀ reads
    tangent.topLeftCorner(n_, n_) = model_.energy.tangent(z);
    tangent.bottomLeftCorner(others_, n_) += model_.companion * pairs;
    const VectorXd g = companion_transposed_ * q.tail(others_);
    for (Index c = 0, at = 0; c < n_; ++c)
      for (Index r = 0; r <= c; ++r, ++at) {
        tangent(r, c) += g(at);
        tangent(c, r) += g(at);
      }
    return dense_solver(m, k, tangent);
  }

 private:
  void add_coupling(const VectorXd& z, const VectorXd& y, VectorXd& force) const {
    add_product(zy_, y, force.head(n_));
    add_product(yz_, z, force.tail(others_));
  }

  const TensorModel& model_;
  Index n_, others_;
  MatrixXd zz_, zy_, yz_;  // the energy has zz_ too
  VectorXd yy_;
  MatrixXd companion_transposed_;
};

/// The same space and the same first n vectors, the others turned among themselves until their stiffness is diagonal.
ReducedBasis turned(const ReducedBasis& basis, Index n) {
  const Index others = basis.vectors.cols() - n;
  ReducedBasis result = basis;
  if (others == 0) return result;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> own(basis.stiffness.bottomRightCorner(others, others));
  result.vectors.rightCols(others) = basis.vectors.rightCols(others) * own.eigenvectors();
  result.stiffness.topRightCorner(n, others) = basis.stiffness.topRightCorner(n, others) * own.eigenvectors();
  result.stiffness.bottomLeftCorner(others, n) = result.stiffness.topRightCorner(n, others).transpose();
  result.stiffness.bottomRightCorner(others, others) = own.eigenvalues().asDiagonal();
  return result;
}

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
                         const ReducedBasis& given, std::size_t nonlinear_count) {
  const auto n = static_cast<Index>(nonlinear_count);
  require(n >= 1 && n <= given.vectors.cols(), "{} nonlinear vectors of {}; ask for no more than there are", n,
          given.vectors.cols());
  const ReducedBasis basis = turned(given, n);
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
