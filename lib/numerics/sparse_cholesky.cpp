#include "lib/numerics/sparse_cholesky.hpp"

#include "lib/contract/require.hpp"
#include "lib/numerics/single_thread_blas.hpp"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCholesky>

namespace impulse {

using Sparse = Eigen::SparseMatrix<double>;

struct SparseCholesky::Factor {
  Eigen::CholmodSupernodalLLT<Sparse, Eigen::Lower> llt;
};

SparseCholesky::SparseCholesky(std::unique_ptr<Factor> factor) : factor_(std::move(factor)) {}
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;
SparseCholesky::~SparseCholesky() = default;

std::optional<SparseCholesky> SparseCholesky::of(const Sparse& a) {
  require(a.rows() == a.cols(), "a matrix {} x {} has no Cholesky factor", a.rows(), a.cols());
  use_one_blas_thread();
  auto factor = std::make_unique<Factor>();
  factor->llt.cholmod().print = 0;  // that A is indefinite is an answer here, not a message
  factor->llt.compute(a);
  if (factor->llt.info() != Eigen::Success) return std::nullopt;
  return SparseCholesky(std::move(factor));
}

Eigen::VectorXd SparseCholesky::solve(const Eigen::VectorXd& b) const {
  require(b.rows() == factor_->llt.rows(), "{} rows do not fit {} unknowns", b.rows(), factor_->llt.rows());
  return factor_->llt.solve(b);
}

Eigen::MatrixXd SparseCholesky::solve(const Eigen::MatrixXd& b) const {
  require(b.rows() == factor_->llt.rows(), "{} rows do not fit {} unknowns", b.rows(), factor_->llt.rows());
  return factor_->llt.solve(b);
}

std::optional<Eigen::VectorXd> answer_of_held(const SparseCholesky& factor, const Sparse& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd x = factor.solve(b);
  if (!((a * x - b).norm() <= 1e-6 * b.norm())) return std::nullopt;
  return x;
}

LinearSolver symmetric_solver(const Sparse& a) {
  if (auto definite = SparseCholesky::of(a)) {
    const auto factor = std::make_shared<SparseCholesky>(std::move(*definite));
    return [factor](const Eigen::VectorXd& b) { return factor->solve(b); };
  }
  const auto factor = std::make_shared<Eigen::SimplicialLDLT<Sparse>>(a);
  if (factor->info() != Eigen::Success || !factor->vectorD().allFinite()) return {};
  return [factor](const Eigen::VectorXd& b) -> Eigen::VectorXd { return factor->solve(b); };
}

}  // namespace impulse
