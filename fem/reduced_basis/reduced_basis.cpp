#include "fem/reduced_basis/reduced_basis.hpp"

#include "lib/contract/require.hpp"
#include "lib/model/rigid_modes.hpp"
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
/// returns the share of its length that was left.
double orthonormalise(const Sparse& mass, const MatrixXd& columns, Eigen::Index count, VectorXd& vector) {
  const double before = std::sqrt(vector.dot(mass * vector));
  for (int pass = 0; pass < 2; ++pass) {
    const VectorXd weighted = mass * vector;
    vector -= columns.leftCols(count) * (columns.leftCols(count).transpose() * weighted);
  }
  const double after = std::sqrt(vector.dot(mass * vector));
  if (after > 0) vector /= after;
  return before > 0 ? after / before : 0;
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

ReducedBasis ritz_basis(const Sparse& stiffness, const Sparse& mass, const VectorXd& load, std::size_t count) {
  const Eigen::Index n = mass.rows();
  require(count >= 1 && static_cast<Eigen::Index>(count) <= n,
          "{} vectors are asked for, but the mesh has {} degrees of freedom; use more elements", count, n);
  require(load.size() == n && load.squaredNorm() > 0, "Ritz vectors need a load that isn't zero");
  const Eigen::SimplicialLDLT<Sparse> factor(stiffness);
  require(factor.info() == Eigen::Success, "the stiffness matrix cannot be factorised; hold the panel at its edges");
  MatrixXd vectors(n, static_cast<Eigen::Index>(count));
  Eigen::Index found = 0;
  VectorXd next = factor.solve(load);
  while (found < vectors.cols()) {
    // What is left of a vector that lies in the span of those before is their rounding.
    if (orthonormalise(mass, vectors, found, next) < 1e-12) break;
    vectors.col(found++) = next;
    next = factor.solve(mass * next);
  }
  vectors.conservativeResize(Eigen::NoChange, found);
  MatrixXd reduced = vectors.transpose() * (stiffness * vectors);
  return {vectors, (reduced + reduced.transpose()) / 2};
}

ReducedBasis appended(const ReducedBasis& basis, const MatrixXd& vectors, const Sparse& stiffness, const Sparse& mass) {
  MatrixXd all(basis.vectors.rows(), basis.vectors.cols() + vectors.cols());
  all.leftCols(basis.vectors.cols()) = basis.vectors;
  Eigen::Index count = basis.vectors.cols();
  for (Eigen::Index k = 0; k < vectors.cols(); ++k) {
    VectorXd next = vectors.col(k);
    if (orthonormalise(mass, all, count, next) < 1e-6) continue;
    all.col(count++) = next;
  }
  all.conservativeResize(Eigen::NoChange, count);
  const MatrixXd reduced = all.transpose() * (stiffness * all);
  return {all, (reduced + reduced.transpose()) / 2};
}

}  // namespace impulse
