#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include <memory>

namespace impulse {

/// x = M⁻¹ y of a mass matrix: a division where M is diagonal, else by its sparse Cholesky factors (consistent mass).
/// Copies share the factors. Verified by: tests/fem/central_difference.test.cpp
class MassSolver {
 public:
  /// @throws std::invalid_argument if M is not positive definite; of a diagonal one, naming the degree of freedom.
  explicit MassSolver(const Eigen::SparseMatrix<double>& mass);

  [[nodiscard]] Eigen::Index size() const { return size_; }

  /// Writes M⁻¹y into x, which has its size.
  void solve(const Eigen::VectorXd& y, Eigen::VectorXd& x) const;

  [[nodiscard]] Eigen::VectorXd solved(const Eigen::VectorXd& y) const;

 private:
  Eigen::Index size_;
  Eigen::VectorXd inverse_;  // of a diagonal; else empty
  std::shared_ptr<const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>> factors_;
};

}  // namespace impulse
