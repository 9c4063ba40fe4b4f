#pragma once

#include "lib/model/modal_model.hpp"
#include "lib/numerics/eigenpairs.hpp"

#include <Eigen/Dense>
#include <Eigen/Sparse>

namespace impulse {

/// The lowest pairs K u = λ M u that the options ask for by count and by `limit` [rad²/s²], a few more perhaps, by the
/// route they name or the cheapest: LAPACK for tridiagonal and for small or nearly complete problems, ARPACK about the
/// lowest modes else.
/// @throws std::invalid_argument for a route that the matrices do not take; ConvergenceError.
/// Verified by: tests/lib/modal_model.test.cpp
[[nodiscard]] Eigenpairs structure_eigenpairs(const Eigen::SparseMatrix<double>& k,
                                              const Eigen::SparseMatrix<double>& m, const ModalOptions& options,
                                              double limit);
[[nodiscard]] Eigenpairs structure_eigenpairs(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m,
                                              const ModalOptions& options, double limit);

}  // namespace impulse
