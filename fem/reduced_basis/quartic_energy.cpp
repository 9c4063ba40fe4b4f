#include "fem/reduced_basis/quartic_energy.hpp"

#include "fem/reduced_basis/wide_product.hpp"
#include "lib/contract/require.hpp"

#include <algorithm>
#include <array>

namespace impulse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Index pair(Index j, Index k) {
  if (j > k) std::swap(j, k);
  return k * (k + 1) / 2 + j;
}

Index triple(Index j, Index k, Index l) {
  std::array<Index, 3> i{j, k, l};
  std::sort(i.begin(), i.end());
  return i[2] * (i[2] + 1) * (i[2] + 2) / 6 + i[1] * (i[1] + 1) / 2 + i[0];
}

VectorXd triple_products(const VectorXd& z, const VectorXd& pairs) {
  const Index n = z.size();
  VectorXd t(n * (n + 1) * (n + 2) / 6);
  for (Index l = 0, at = 0; l < n; ++l) {
    const Index count = (l + 1) * (l + 2) / 2;
    t.segment(at, count) = z(l) * pairs.head(count);
    at += count;
  }
  return t;
}

/// The polynomial from values, in units in which every basis vector is one.
class Sampling {
 public:
  Sampling(const std::function<VectorXd(const VectorXd&)>& force, const Eigen::SparseMatrix<double>& stiffness,
           const MatrixXd& vectors)
      : force_(force), vectors_(vectors), linear_(stiffness * vectors) {
    const Index n = vectors.cols(), pairs = n * (n + 1) / 2;
    reduced_linear_ = vectors.transpose() * linear_;
    quadratic_ = MatrixXd::Zero(vectors.rows(), pairs);
    cubic_ = MatrixXd::Zero(n, n * (n + 1) * (n + 2) / 6);
    for (Index j = 0; j < n; ++j) single(j);
    for (Index k = 0; k < n; ++k)
      for (Index j = 0; j < k; ++j) twin(j, k);
    reduced_quadratic_ = vectors.transpose() * quadratic_;
    for (Index l = 0; l < n; ++l)
      for (Index k = 0; k < l; ++k)
        for (Index j = 0; j < k; ++j) triplet(j, k, l);
  }

  [[nodiscard]] const MatrixXd& linear() const { return reduced_linear_; }
  [[nodiscard]] const MatrixXd& reduced_quadratic() const { return reduced_quadratic_; }
  [[nodiscard]] const MatrixXd& quadratic() const { return quadratic_; }
  [[nodiscard]] const MatrixXd& cubic() const { return cubic_; }

 private:
  auto b(Index j, Index k, Index l) { return cubic_.col(triple(j, k, l)); }

  void single(Index j) {
    const VectorXd plus = force_(vectors_.col(j)), minus = force_(-vectors_.col(j));
    quadratic_.col(pair(j, j)) = (plus + minus) / 2;
    b(j, j, j) = vectors_.transpose() * ((plus - minus) / 2 - linear_.col(j));
  }

  void twin(Index j, Index k) {
    const VectorXd sum = vectors_.col(j) + vectors_.col(k);
    const VectorXd plus = force_(sum), minus = force_(-sum);
    const VectorXd squares = quadratic_.col(pair(j, j)) + quadratic_.col(pair(k, k));
    quadratic_.col(pair(j, k)) = (plus + minus) / 2 - squares;
    const VectorXd of_sum = vectors_.transpose() * ((plus - minus) / 2 - linear_.col(j) - linear_.col(k));
    const VectorXd of_difference =
        vectors_.transpose() * (force_(vectors_.col(j) - vectors_.col(k)) - squares + quadratic_.col(pair(j, k)) -
                                linear_.col(j) + linear_.col(k));
    b(j, k, k) = (of_sum + of_difference) / 2 - b(j, j, j);
    b(j, j, k) = (of_sum - of_difference) / 2 - b(k, k, k);
  }

  void triplet(Index j, Index k, Index l) {
    VectorXd rest = vectors_.transpose() * force_(vectors_.col(j) + vectors_.col(k) + vectors_.col(l));
    for (const Index i : {j, k, l}) rest -= reduced_linear_.col(i) + reduced_quadratic_.col(pair(i, i)) + b(i, i, i);
    for (const auto& [i, m] : {std::pair{j, k}, std::pair{j, l}, std::pair{k, l}})
      rest -= reduced_quadratic_.col(pair(i, m)) + b(i, i, m) + b(i, m, m);
    b(j, k, l) = rest;
  }

  const std::function<VectorXd(const VectorXd&)>& force_;
  const MatrixXd& vectors_;
  MatrixXd linear_, reduced_linear_, quadratic_, reduced_quadratic_, cubic_;
};

}  // namespace

VectorXd pair_products(const VectorXd& z) {
  const Index n = z.size();
  VectorXd p(n * (n + 1) / 2);
  for (Index k = 0, at = 0; k < n; at += ++k) p.segment(at, k + 1) = z(k) * z.head(k + 1);
  return p;
}

MatrixXd pair_derivatives(const VectorXd& z) {
  const Index n = z.size();
  MatrixXd p = MatrixXd::Zero(n * (n + 1) / 2, n);
  for (Index k = 0, at = 0; k < n; ++k)
    for (Index j = 0; j <= k; ++j, ++at) {
      p(at, j) += z(k);
      p(at, k) += z(j);
    }
  return p;
}

VectorXd QuarticEnergy::force(const VectorXd& z, const VectorXd& pairs) const {
  VectorXd f = VectorXd::Zero(z.size());
  add_product(cubic, triple_products(z, pairs), f);
  add_product(quadratic, pairs, f);
  add_product(stiffness, z, f);
  return f;
}

MatrixXd QuarticEnergy::tangent(const VectorXd& z) const {
  const Index n = z.size();
  const VectorXd pairs = pair_products(z);
  const MatrixXd by_z = pair_derivatives(z);
  MatrixXd triples = MatrixXd::Zero(cubic.cols(), n);
  for (Index l = 0, at = 0; l < n; ++l) {
    const Index count = (l + 1) * (l + 2) / 2;
    triples.middleRows(at, count) = z(l) * by_z.topRows(count);
    triples.col(l).segment(at, count) += pairs.head(count);
    at += count;
  }
  return stiffness + quadratic * by_z + cubic * triples;
}

double QuarticEnergy::energy(const VectorXd& z) const {
  const VectorXd pairs = pair_products(z);
  return z.dot(stiffness * z) / 2 + z.dot(quadratic * pairs) / 3 + z.dot(cubic * triple_products(z, pairs)) / 4;
}

QuarticReduction quartic_reduction(const std::function<VectorXd(const VectorXd&)>& internal_force,
                                   const Eigen::SparseMatrix<double>& stiffness, const MatrixXd& basis,
                                   const VectorXd& amplitude) {
  const Index n = basis.cols();
  require(n >= 1 && n <= 40, "tensors of {} vectors (1 to 40) are dearer than evaluating the mesh", n);
  require(amplitude.size() == n && (amplitude.array() > 0).all() && stiffness.rows() == basis.rows(),
          "{} amplitudes for {} vectors, a stiffness of {} rows for vectors of {}", amplitude.size(), n,
          stiffness.rows(), basis.rows());
  const MatrixXd vectors = basis * amplitude.asDiagonal();
  const Sampling sampled(internal_force, stiffness, vectors);
  // Back to the units of the basis: divided by the amplitude of every index.
  const VectorXd inverse = amplitude.cwiseInverse(), pairs = pair_products(inverse);
  QuarticReduction reduction;
  QuarticEnergy& energy = reduction.energy;
  energy.stiffness = inverse.asDiagonal() * sampled.linear() * inverse.asDiagonal();
  energy.quadratic = inverse.asDiagonal() * sampled.reduced_quadratic() * pairs.asDiagonal();
  energy.cubic = inverse.asDiagonal() * sampled.cubic() * triple_products(inverse, pairs).asDiagonal();
  reduction.quadratic_force = sampled.quadratic() * pairs.asDiagonal();
  return reduction;
}

void condense(QuarticEnergy& energy, const MatrixXd& g) {
  const Index n = energy.size();
  require(g.rows() == n * (n + 1) / 2 && g.cols() == g.rows(), "a matrix {} x {} for {} pairs", g.rows(), g.cols(),
          n * (n + 1) / 2);
  for (Index k = 0; k < n; ++k)
    for (Index j = 0; j <= k; ++j)
      for (Index m = 0; m < n; ++m)
        for (Index l = 0; l <= m; ++l) {
          const double term = g(pair(j, k), pair(l, m)) / 2;
          energy.cubic(j, triple(k, l, m)) -= term;
          energy.cubic(k, triple(j, l, m)) -= term;
          energy.cubic(l, triple(j, k, m)) -= term;
          energy.cubic(m, triple(j, k, l)) -= term;
        }
}

}  // namespace impulse
