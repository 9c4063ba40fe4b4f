#include "fem/bodies/assembly.hpp"

#include "lib/contract/require.hpp"

namespace impulse {

FreeDofs::FreeDofs(Eigen::Index dof_count, std::span<const Eigen::Index> held_dofs)
    : number_(static_cast<std::size_t>(dof_count), 0) {
  for (const Eigen::Index dof : held_dofs) {
    require(dof >= 0 && dof < dof_count, "degree of freedom {} is to be held, but there are {}", dof, dof_count);
    number_[static_cast<std::size_t>(dof)] = held;
  }
  for (Eigen::Index& number : number_)
    if (number != held) number = count_++;
  require(count_ > 0, "every degree of freedom is held; use more elements");
}

void MatrixAssembly::add(std::span<const Eigen::Index> dofs, const Eigen::Ref<const Eigen::MatrixXd>& element) {
  for (std::size_t i = 0; i < dofs.size(); ++i)
    for (std::size_t j = 0; j < dofs.size(); ++j) {
      const Eigen::Index row = dofs_[dofs[i]], column = dofs_[dofs[j]];
      const double value = element(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (row != FreeDofs::held && column != FreeDofs::held && value != 0) entries_.emplace_back(row, column, value);
    }
}

Eigen::SparseMatrix<double> MatrixAssembly::matrix() const {
  Eigen::SparseMatrix<double> sum(dofs_.count(), dofs_.count());
  sum.setFromTriplets(entries_.begin(), entries_.end());
  return sum;
}

}  // namespace impulse
