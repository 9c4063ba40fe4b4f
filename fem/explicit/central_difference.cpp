#include "fem/explicit/central_difference.hpp"

#include "lib/contract/require.hpp"

#include <Eigen/SparseCholesky>

#include <cmath>
#include <limits>
#include <utility>

namespace impulse {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

bool is_tridiagonal(const Sparse& matrix) {
  for (Eigen::Index j = 0; j < matrix.outerSize(); ++j)
    for (Sparse::InnerIterator entry(matrix, j); entry; ++entry)
      if (std::abs(entry.row() - j) > 1) return false;
  return true;
}

bool is_positive_definite(const Sparse& matrix, Eigen::SimplicialLLT<Sparse>& factorisation) {
  factorisation.factorize(matrix);
  return factorisation.info() == Eigen::Success;
}

Sparse damped(const Sparse& mass, const Eigen::VectorXd& dashpots, double step_s) {
  require(dashpots.size() == 0 || dashpots.size() == mass.rows(), "{} dashpots for {} degrees of freedom",
          dashpots.size(), mass.rows());
  if (dashpots.size() == 0) return mass;
  Sparse sum = mass;
  for (Eigen::Index i = 0; i < dashpots.size(); ++i) sum.coeffRef(i, i) += 0.5 * step_s * dashpots[i];
  return sum;
}

/// Three significant digits, never more than the value.
double rounded_down(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2);
  return std::floor(value / unit * (1 + 1e-14)) * unit;
}

}  // namespace

InternalForce linear_internal_force(const Sparse& stiffness) {
  const Eigen::Index n = stiffness.rows();
  if (n < 2 || !is_tridiagonal(stiffness))
    return [stiffness](const Eigen::VectorXd& d, Eigen::VectorXd& f) { f.noalias() = stiffness * d; };
  // As springs between neighbours and to the ground, so that what one element loses the next one gains to the last bit:
  // K's own rows sum to rounding only, which leaks momentum at the rate of rounding times the distance flown.
  const Eigen::VectorXd main = stiffness.diagonal();
  Eigen::VectorXd spring(n - 1);
  for (Eigen::Index i = 0; i + 1 < n; ++i) spring[i] = -stiffness.coeff(i + 1, i);
  Eigen::VectorXd ground = main;
  ground.head(n - 1) -= spring;
  ground.tail(n - 1) -= spring;
  for (Eigen::Index i = 0; i < n; ++i)
    if (std::abs(ground[i]) <= 8 * std::numeric_limits<double>::epsilon() * main[i]) ground[i] = 0;
  return [spring, ground, n](const Eigen::VectorXd& d, Eigen::VectorXd& f) {
    double tension_before = 0;
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
      const double tension = spring[i] * (d[i + 1] - d[i]);
      f[i] = ground[i] * d[i] + tension_before - tension;
      tension_before = tension;
    }
    f[n - 1] = ground[n - 1] * d[n - 1] + tension_before;
  };
}

MotionState MotionState::at_rest(Eigen::Index dof_count) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dof_count);
  return {zero, zero, zero};
}

CentralDifference::CentralDifference(const Sparse& mass, const Eigen::VectorXd& dashpots, InternalForce internal_force,
                                     double step_s)
    : step_s_(step_s),
      dashpots_(dashpots),
      mass_(mass),
      damped_mass_(damped(mass, dashpots, step_s)),
      internal_force_(std::move(internal_force)),
      unbalanced_(Eigen::VectorXd::Zero(mass.rows())) {
  require(std::isfinite(step_s) && step_s > 0, "step {} s is not positive", step_s);
}

CentralDifference::CentralDifference(const Structure& body, double step_s)
    : CentralDifference(body.mass, body.dashpots, linear_internal_force(body.stiffness), step_s) {}

void CentralDifference::set_load(MotionState& state, const Eigen::VectorXd& load) {
  internal_force_(state.displacement, unbalanced_);
  unbalanced_ = load - unbalanced_;
  if (dashpots_.size() > 0) unbalanced_ -= dashpots_.cwiseProduct(state.velocity);
  mass_.solve(unbalanced_, state.acceleration);
}

void CentralDifference::advance(MotionState& state, const Eigen::VectorXd& load) {
  state.displacement += step_s_ * state.velocity + (0.5 * step_s_ * step_s_) * state.acceleration;
  state.velocity += (0.5 * step_s_) * state.acceleration;
  internal_force_(state.displacement, unbalanced_);
  unbalanced_ = load - unbalanced_;
  if (dashpots_.size() > 0) unbalanced_ -= dashpots_.cwiseProduct(state.velocity);
  damped_mass_.solve(unbalanced_, state.acceleration);
  state.velocity += (0.5 * step_s_) * state.acceleration;
}

double stability_limit_s(const Structure& body) {
  const Sparse& k = body.stiffness;
  const Sparse& m = body.mass;
  require(k.rows() > 0 && k.rows() == m.rows(), "stiffness of {} and mass of {} degrees of freedom", k.rows(),
          m.rows());
  double low = 0;
  for (Eigen::Index i = 0; i < k.rows(); ++i) {
    require(m.coeff(i, i) > 0, "mass {} kg of degree of freedom {} is not positive", m.coeff(i, i), i);
    low = std::max(low, k.coeff(i, i) / m.coeff(i, i));
  }
  if (low == 0) return std::numeric_limits<double>::infinity();

  // The pattern is analysed once, on K + M, so that a λM - K with cancelled entries keeps it.
  Sparse shifted = k + m;
  Eigen::SimplicialLLT<Sparse> factorisation;
  factorisation.analyzePattern(shifted);
  const auto above_spectrum = [&](double lambda) {
    shifted = lambda * m - k;
    return is_positive_definite(shifted, factorisation);
  };
  double high = 2 * low;
  while (!above_spectrum(high)) {
    low = high;
    high *= 2;
    require(std::isfinite(high), "a mass matrix that is not positive definite has no stability limit");
  }
  while (high - low > 1e-13 * high) {
    const double middle = 0.5 * (low + high);
    (above_spectrum(middle) ? high : low) = middle;
  }
  return 2 / std::sqrt(high);
}

void require_stable_step(const Structure& body, double step_s, const char* name) {
  const double limit = stability_limit_s(body);
  require(step_s <= limit * (1 + 1e-12),
          "step {:.4g} us exceeds the stability limit {:.4g} us of the {}; use --step {:.3g}us", step_s * 1e6,
          limit * 1e6, name, rounded_down(limit * 1e6));
}

}  // namespace impulse
