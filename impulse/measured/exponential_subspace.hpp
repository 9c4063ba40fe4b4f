#pragma once

#include <Eigen/Dense>

#include <complex>
#include <vector>

namespace impulse {

/// Signal subspace of a series that is a sum of exponentials with noise: eigenvectors of H Hᵀ, H_ij = y_(i+j) the
/// Hankel matrix of a third of the samples by the rest, at most 400 rows; strongest first.
class ExponentialSubspace {
 public:
  /// @throws std::invalid_argument for fewer than 12 samples.
  explicit ExponentialSubspace(const std::vector<double>& series);

  [[nodiscard]] Eigen::Index largest_dimension() const { return basis_.cols() / 2; }

  /// Poles z of the sum of `dimension` exponentials that the subspace's shift invariance tells: eigenvalues of the
  /// least squares solution of V↑ Ψ = V↓. Verified by: tests/impulse/mode_identification.test.cpp
  [[nodiscard]] std::vector<std::complex<double>> poles(Eigen::Index dimension) const;

 private:
  Eigen::MatrixXd basis_;
};

}  // namespace impulse
