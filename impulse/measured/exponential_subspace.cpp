#include "impulse/measured/exponential_subspace.hpp"

#include "lib/contract/require.hpp"
#include "lib/numerics/eigenpairs.hpp"

#include <algorithm>

namespace impulse {

ExponentialSubspace::ExponentialSubspace(const std::vector<double>& series) {
  const auto size = static_cast<Eigen::Index>(series.size());
  require(size >= 12, "{} samples in the band are too few to find modes in", size);
  const Eigen::Index rows = std::min<Eigen::Index>(400, size / 3);
  const Eigen::Index columns = size - rows + 1;
  const Eigen::Map<const Eigen::VectorXd> y(series.data(), size);
  // H Hᵀ by diagonals: (i+1, j+1) is (i, j) with one product gone and one come.
  Eigen::MatrixXd gram(rows, rows);
  for (Eigen::Index lag = 0; lag < rows; ++lag) {
    double sum = y.head(columns).dot(y.segment(lag, columns));
    for (Eigen::Index i = 0; i + lag < rows; ++i) {
      gram(i, i + lag) = gram(i + lag, i) = sum;
      if (i + lag + 1 < rows) sum += y(i + columns) * y(i + lag + columns) - y(i) * y(i + lag);
    }
  }
  basis_ = dense_eigenpairs(gram, Eigen::MatrixXd::Identity(rows, rows), static_cast<std::size_t>(rows))
               .vectors.rowwise()
               .reverse();
}

std::vector<std::complex<double>> ExponentialSubspace::poles(Eigen::Index dimension) const {
  const Eigen::Index rows = basis_.rows();
  require(dimension >= 1 && dimension <= largest_dimension(), "{} exponentials from {} rows", dimension, rows);
  const Eigen::MatrixXd upper = basis_.topLeftCorner(rows - 1, dimension);
  const Eigen::MatrixXd lower = basis_.bottomLeftCorner(rows - 1, dimension);
  // V has orthonormal columns: V↑ᵀV↑ = 1 - v vᵀ, v its last row.
  const Eigen::MatrixXd shift = (upper.transpose() * upper).ldlt().solve(upper.transpose() * lower);
  const Eigen::VectorXcd values = shift.eigenvalues();
  return {values.data(), values.data() + values.size()};
}

}  // namespace impulse
