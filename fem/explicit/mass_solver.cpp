#include "fem/explicit/mass_solver.hpp"

#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {
namespace {

bool is_diagonal(const Eigen::SparseMatrix<double>& matrix) {
  for (Eigen::Index j = 0; j < matrix.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, j); entry; ++entry)
      if (entry.row() != j && entry.value() != 0) return false;
  return true;
}

}  // namespace

MassSolver::MassSolver(const Eigen::SparseMatrix<double>& mass) : size_(mass.rows()) {
  require(size_ > 0 && mass.cols() == size_, "a mass matrix of {} x {}", mass.rows(), mass.cols());
  const Eigen::VectorXd diagonal = mass.diagonal();
  for (Eigen::Index i = 0; i < size_; ++i)
    require(std::isfinite(diagonal[i]) && diagonal[i] > 0, "mass {} kg of degree of freedom {} is not positive",
            diagonal[i], i);
  if (is_diagonal(mass)) {
    inverse_ = diagonal.cwiseInverse();
    return;
  }
  const auto factors = std::make_shared<Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>>(mass);
  require(factors->info() == Eigen::Success, "the mass matrix is not positive definite");
  factors_ = factors;
}

void MassSolver::solve(const Eigen::VectorXd& y, Eigen::VectorXd& x) const {
  if (factors_)
    x = factors_->solve(y);
  else
    x = inverse_.cwiseProduct(y);
}

Eigen::VectorXd MassSolver::solved(const Eigen::VectorXd& y) const {
  Eigen::VectorXd x(size_);
  solve(y, x);
  return x;
}

}  // namespace impulse
