#include "fem/reduced_basis/reduced_basis.hpp"

#include "lib/contract/require.hpp"
#include "lib/model/rigid_modes.hpp"
#include "lib/numerics/dense_algebra.hpp"
#include "lib/numerics/eigenpairs.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace impulse {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

Eigenpairs lowest_modes(const Structure& body, std::size_t count) {
  const auto n = static_cast<std::size_t>(body.mass.rows());
  if (n <= 200 || 5 * count >= n) return dense_eigenpairs(MatrixXd(body.stiffness), MatrixXd(body.mass), count);
  return shift_invert_eigenpairs(body.stiffness, body.mass, count,
                                 -elastic_eigenvalue_scale(body.stiffness, body.mass));
}

/// `vector` made M-orthogonal to the first columns, twice (once leaves what cancellation spares), and of unit M-norm;
/// returns the share of its length that was left. `weighted` holds the products of M with the columns, and gets that
/// with the vector.
double orthonormalise(const Sparse& mass, const MatrixXd& columns, MatrixXd& weighted, Eigen::Index count,
                      VectorXd& vector) {
  const double before = std::sqrt(vector.dot(mass * vector));
  for (int pass = 0; pass < 2; ++pass) {
    const VectorXd share = weighted.leftCols(count).transpose() * vector;
    vector.noalias() -= columns.leftCols(count) * share;
  }
  weighted.col(count).noalias() = mass * vector;
  const double after = std::sqrt(vector.dot(weighted.col(count)));
  if (after > 0) {
    vector /= after;
    weighted.col(count) /= after;
  }
  return before > 0 ? after / before : 0;
}

/// VᵀKV, symmetric to the last bit.
MatrixXd projected(const Sparse& stiffness, const MatrixXd& vectors) {
  const MatrixXd product = stiffness * vectors;
  MatrixXd reduced = MatrixXd::Zero(vectors.cols(), vectors.cols());
  add_transposed_product(vectors, product, reduced);
  return (reduced + reduced.transpose()) / 2;
}

}  // namespace

VectorXd normal_share(const Shell& shell, const MatrixXd& modes) {
  const auto& functions = shell_functions_at_gauss_points();
  VectorXd along = VectorXd::Zero(modes.cols()), whole = VectorXd::Zero(modes.cols());
  MatrixXd values(shell.nodal_values(VectorXd::Zero(shell.size())).size(), modes.cols());
  for (Eigen::Index k = 0; k < modes.cols(); ++k) values.col(k) = shell.nodal_values(modes.col(k));
  for (const ShellElement& element : shell.elements())
    for (std::size_t p = 0; p < shell_gauss_points; ++p) {
      const ShellPoint point = shell_point(functions[p], element.surface);
      for (Eigen::Index k = 0; k < modes.cols(); ++k) {
        const Eigen::Vector3d u = coefficients_of(element, values.col(k)).transpose() * functions[p].value;
        along(k) += shell_gauss_weight(p) * point.area * std::pow(u.dot(point.n), 2);
        whole(k) += shell_gauss_weight(p) * point.area * u.squaredNorm();
      }
    }
  return along.cwiseQuotient(whole);
}

ReducedBasis modal_basis(const Shell& shell, const Structure& body, std::size_t count, ModeKind kind) {
  const auto n = static_cast<std::size_t>(body.mass.rows());
  require(count >= 1 && count <= n, "{} modes are asked for, but the mesh has {} degrees of freedom; use more elements",
          count, n);
  for (std::size_t tried = count;; tried = std::min(n, 2 * tried)) {
    const Eigenpairs pairs = lowest_modes(body, tried);
    require(!is_rigid(body.stiffness, pairs.vectors.col(0)),
            "the panel can move as a rigid body, which has no place among its modes here; hold it at its edges");
    std::vector<Eigen::Index> chosen;
    const VectorXd share =
        kind == ModeKind::any ? VectorXd::Ones(pairs.values.size()) : normal_share(shell, pairs.vectors);
    for (Eigen::Index k = 0; k < share.size() && chosen.size() < count; ++k)
      if (share(k) > 0.5) chosen.push_back(k);
    if (chosen.size() == count) return {pairs.vectors(Eigen::all, chosen), MatrixXd(pairs.values(chosen).asDiagonal())};
    require(tried < n, "{} flexural modes are asked for, but the mesh has only {}; use more elements", count,
            chosen.size());
  }
}

ReducedBasis ritz_basis(const LinearSolver& inverse, const Sparse& stiffness, const Sparse& mass, const VectorXd& load,
                        std::size_t count) {
  const Eigen::Index n = mass.rows();
  require(count >= 1 && static_cast<Eigen::Index>(count) <= n,
          "{} vectors are asked for, but the mesh has {} degrees of freedom; use more elements", count, n);
  require(load.size() == n && load.squaredNorm() > 0, "Ritz vectors need a load that isn't zero");
  MatrixXd vectors(n, static_cast<Eigen::Index>(count)), weighted(n, static_cast<Eigen::Index>(count));
  Eigen::Index found = 0;
  VectorXd next = inverse(load);
  while (found < vectors.cols()) {
    // What is left of a vector that lies in the span of those before is their rounding.
    if (orthonormalise(mass, vectors, weighted, found, next) < 1e-12) break;
    vectors.col(found) = next;
    next = inverse(weighted.col(found++));
  }
  vectors.conservativeResize(Eigen::NoChange, found);
  return {vectors, projected(stiffness, vectors)};
}

ReducedBasis ritz_basis(const Sparse& stiffness, const Sparse& mass, const VectorXd& load, std::size_t count) {
  const LinearSolver inverse = symmetric_solver(stiffness);
  require(static_cast<bool>(inverse), "the stiffness matrix cannot be factorised; hold the panel at its edges");
  return ritz_basis(inverse, stiffness, mass, load, count);
}

ReducedBasis appended(const ReducedBasis& basis, const MatrixXd& vectors, const Sparse& stiffness, const Sparse& mass) {
  const Eigen::Index first = basis.vectors.cols(), most = first + vectors.cols();
  MatrixXd all(basis.vectors.rows(), most), weighted(basis.vectors.rows(), most);
  all.leftCols(first) = basis.vectors;
  weighted.leftCols(first) = mass * basis.vectors;
  Eigen::Index count = first;
  for (Eigen::Index k = 0; k < vectors.cols(); ++k) {
    VectorXd next = vectors.col(k);
    if (orthonormalise(mass, all, weighted, count, next) < 1e-6) continue;
    all.col(count++) = next;
  }
  all.conservativeResize(Eigen::NoChange, count);
  return {all, projected(stiffness, all)};
}

}  // namespace impulse
