#include "fem/shell/shell.hpp"

#include <algorithm>

namespace impulse {
namespace {

using ElementMatrix = Eigen::Matrix<double, 48, 48>;
using Functions = Eigen::Matrix<double, 16, 1>;

/// ∂(ε, κ)/∂coefficients at a displacement with the tangents x1 = a1 + u_,1 and x2.
Eigen::Matrix<double, 6, 48> strain_matrix(const ShellPoint& point, const ShellFunctions& f, const Eigen::Vector3d& x1,
                                           const Eigen::Vector3d& x2) {
  Eigen::Matrix<double, 6, 48> b;
  const auto bending = [&](const Functions& second, int k) -> Functions {
    return point.gamma(k, 0) * f.d1 + point.gamma(k, 1) * f.d2 - second;
  };
  const Functions k11 = bending(f.d11, 0), k22 = bending(f.d22, 1), k12 = bending(2 * f.d12, 2);
  for (int c = 0; c < 3; ++c) {
    Eigen::Ref<Eigen::Matrix<double, 6, 16>, 0, Eigen::OuterStride<>> block = b.block<6, 16>(0, 16 * c);
    block.row(0) = x1(c) * f.d1.transpose();
    block.row(1) = x2(c) * f.d2.transpose();
    block.row(2) = x1(c) * f.d2.transpose() + x2(c) * f.d1.transpose();
    block.row(3) = point.n(c) * k11.transpose();
    block.row(4) = point.n(c) * k22.transpose();
    block.row(5) = point.n(c) * k12.transpose();
  }
  return b;
}

void add_to_each_component(const Eigen::Matrix<double, 16, 16>& block, ElementMatrix& matrix) {
  for (int c = 0; c < 3; ++c) matrix.block<16, 16>(16 * c, 16 * c) += block;
}

}  // namespace

Eigen::MatrixXd Shell::element_basis(const ShellElement& element) const {
  Eigen::Index columns = 0;
  for (int node : element.nodes) columns += nodes_[static_cast<std::size_t>(node)].basis.cols();
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(48, columns);
  Eigen::Index first = 0;
  for (int node : element.nodes) {
    const auto& own = nodes_[static_cast<std::size_t>(node)].basis;
    for (std::size_t k = 0; k < 16; ++k) {
      if (element.dof[k] / 12 != node) continue;
      for (int c = 0; c < 3; ++c)
        basis.row(16 * c + static_cast<Eigen::Index>(k)).segment(first, own.cols()) =
            element.scale[k] * own.row(element.dof[k] % 12 + 4 * c);
    }
    first += own.cols();
  }
  return basis;
}

void Shell::make_pattern() {
  std::vector<std::vector<int>> unknowns;
  std::vector<Eigen::Triplet<double>> entries;
  for (const ShellElement& element : elements_) {
    std::vector<int> own;
    for (int node : element.nodes) {
      const SupportedNode& supported = nodes_[static_cast<std::size_t>(node)];
      for (Eigen::Index j = 0; j < supported.basis.cols(); ++j) own.push_back(static_cast<int>(supported.first + j));
    }
    for (int i : own)
      for (int j : own) entries.emplace_back(i, j, 0.0);
    unknowns.push_back(std::move(own));
  }
  pattern_.resize(size(), size());
  pattern_.setFromTriplets(entries.begin(), entries.end());
  const int* starts = pattern_.outerIndexPtr();
  const int* rows = pattern_.innerIndexPtr();
  for (const std::vector<int>& own : unknowns) {
    position_start_.push_back(position_.size());
    for (int j : own)
      for (int i : own)
        position_.push_back(static_cast<int>(std::lower_bound(rows + starts[j], rows + starts[j + 1], i) - rows));
  }
}

Eigen::SparseMatrix<double> Shell::assembled(
    const std::function<void(std::size_t, ElementMatrix&)>& element_matrix) const {
  Eigen::SparseMatrix<double> matrix = pattern_;
  double* values = matrix.valuePtr();
  ElementMatrix full;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    element_matrix(e, full);
    const Eigen::MatrixXd basis = element_basis(elements_[e]);
    const Eigen::MatrixXd half = full * basis;
    Eigen::MatrixXd own = basis.transpose() * half;
    // Rounding leaves the products of Gauss points unsymmetric in the last bit.
    own = (own + own.transpose()).eval() / 2;
    const int* position = position_.data() + position_start_[e];
    for (Eigen::Index k = 0; k < own.size(); ++k) values[position[k]] += own.data()[k];
  }
  return matrix;
}

Eigen::SparseMatrix<double> Shell::tangent(const Eigen::VectorXd& z) const {
  const Eigen::VectorXd values = unrestrained_ * z;
  const auto& functions = shell_functions_at_gauss_points();
  return assembled([&](std::size_t e, ElementMatrix& matrix) {
    const Coefficients q = coefficients_of(elements_[e], values);
    Eigen::Matrix<double, 6 * shell_gauss_points, 48> strains, stresses;
    Eigen::Matrix<double, 16, 16> geometric = Eigen::Matrix<double, 16, 16>::Zero();
    for (std::size_t p = 0; p < shell_gauss_points; ++p) {
      const ShellFunctions& f = functions[p];
      const ShellPoint& point = points_[shell_gauss_points * e + p];
      const Matrix6d& c = rigidity_[shell_gauss_points * e + p];
      const Eigen::Vector3d x1 = point.a1 + q.transpose() * f.d1, x2 = point.a2 + q.transpose() * f.d2;
      const auto row = static_cast<Eigen::Index>(6 * p);
      strains.middleRows<6>(row) = strain_matrix(point, f, x1, x2);
      stresses.middleRows<6>(row).noalias() = c * strains.middleRows<6>(row);
      const Eigen::Vector3d force = (c * shell_strain(point, f, q)).head<3>();
      const Functions along_1 = force(0) * f.d1 + force(2) * f.d2, along_2 = force(1) * f.d2 + force(2) * f.d1;
      geometric.noalias() += along_1 * f.d1.transpose() + along_2 * f.d2.transpose();
    }
    matrix.noalias() = strains.transpose() * stresses;
    add_to_each_component(geometric, matrix);
  });
}

Eigen::SparseMatrix<double> Shell::mass() const {
  const auto& functions = shell_functions_at_gauss_points();
  Eigen::SparseMatrix<double> matrix = assembled([&](std::size_t e, ElementMatrix& full) {
    Eigen::Matrix<double, 16, 16> block = Eigen::Matrix<double, 16, 16>::Zero();
    for (std::size_t p = 0; p < shell_gauss_points; ++p) {
      const double weight = shell_gauss_weight(p) * points_[shell_gauss_points * e + p].area;
      block.noalias() +=
          (weight * panel_.laminate.mass_kg_per_m2) * functions[p].value * functions[p].value.transpose();
    }
    full.setZero();
    add_to_each_component(block, full);
  });
  // Two thirds of K's pattern couple different components, which have no mass in common where no support turns them.
  return matrix.pruned();
}

}  // namespace impulse
