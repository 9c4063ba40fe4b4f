#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <span>
#include <vector>

namespace impulse {

/// Numbering of the degrees of freedom that are left when some are held at zero: the others in their order.
/// Verified by: tests/fem/assembly.test.cpp
class FreeDofs {
 public:
  static constexpr Eigen::Index held = -1;

  /// @throws std::invalid_argument if one that is held does not exist or none is left. One may be named twice.
  FreeDofs(Eigen::Index dof_count, std::span<const Eigen::Index> held_dofs);

  /// Its number among the free ones, or `held`.
  [[nodiscard]] Eigen::Index operator[](Eigen::Index dof) const { return number_[static_cast<std::size_t>(dof)]; }
  [[nodiscard]] Eigen::Index count() const { return count_; }

 private:
  std::vector<Eigen::Index> number_;
  Eigen::Index count_ = 0;
};

/// Sum of element matrices over the free degrees of freedom; rows and columns of held ones fall away.
/// Verified by: tests/fem/assembly.test.cpp
class MatrixAssembly {
 public:
  explicit MatrixAssembly(const FreeDofs& dofs) : dofs_(dofs) {}

  /// Adds element(i, j) at (dofs[i], dofs[j]).
  void add(std::span<const Eigen::Index> dofs, const Eigen::Ref<const Eigen::MatrixXd>& element);

  [[nodiscard]] Eigen::SparseMatrix<double> matrix() const;

 private:
  const FreeDofs& dofs_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace impulse
