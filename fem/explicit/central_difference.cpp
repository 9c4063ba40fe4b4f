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

Eigen::VectorXd lumped_mass(const Structure& body) {
  for (Eigen::Index j = 0; j < body.mass.outerSize(); ++j)
    for (Sparse::InnerIterator entry(body.mass, j); entry; ++entry)
      require(entry.row() == j || entry.value() == 0,
              "mass matrix has the entry {} at ({}, {}) (explicit integration divides by a diagonal); use lumped mass",
              entry.value(), entry.row(), j);
  Eigen::VectorXd mass = body.mass.diagonal();
  for (Eigen::Index i = 0; i < mass.size(); ++i)
    require(std::isfinite(mass[i]) && mass[i] > 0, "mass {} kg of degree of freedom {} is not positive", mass[i], i);
  return mass;
}

MotionState MotionState::at_rest(Eigen::Index dof_count) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(dof_count);
  return {zero, zero, zero};
}

CentralDifference::CentralDifference(const Eigen::VectorXd& mass, const Eigen::VectorXd& dashpots,
                                     InternalForce internal_force, double step_s)
    : step_s_(step_s),
      inverse_mass_(mass.cwiseInverse()),
      internal_force_(std::move(internal_force)),
      internal_(Eigen::VectorXd::Zero(mass.size())) {
  require(std::isfinite(step_s) && step_s > 0, "step {} s is not positive", step_s);
  require(mass.size() > 0 && mass.minCoeff() > 0, "a mass is not positive");
  require(dashpots.size() == 0 || dashpots.size() == mass.size(), "{} dashpots for {} degrees of freedom",
          dashpots.size(), mass.size());
  if (dashpots.size() > 0) {
    damping_rate_ = dashpots.cwiseProduct(inverse_mass_);
    velocity_divisor_ = Eigen::VectorXd::Ones(mass.size()) + 0.5 * step_s_ * damping_rate_;
  }
}

CentralDifference::CentralDifference(const Structure& body, double step_s)
    : CentralDifference(lumped_mass(body), body.dashpots, linear_internal_force(body.stiffness), step_s) {}

void CentralDifference::set_force(MotionState& state, const Eigen::VectorXd& contact, double force_N) {
  internal_force_(state.displacement, internal_);
  state.acceleration = inverse_mass_.cwiseProduct(force_N * contact - internal_);
  if (damping_rate_.size() > 0) state.acceleration -= damping_rate_.cwiseProduct(state.velocity);
}

void CentralDifference::advance(MotionState& state, const Eigen::VectorXd& contact, double end_force_N) {
  state.displacement += step_s_ * state.velocity + (0.5 * step_s_ * step_s_) * state.acceleration;
  state.velocity += (0.5 * step_s_) * state.acceleration;
  internal_force_(state.displacement, internal_);
  state.acceleration = inverse_mass_.cwiseProduct(end_force_N * contact - internal_);
  if (damping_rate_.size() == 0) {
    state.velocity += (0.5 * step_s_) * state.acceleration;
    return;
  }
  state.velocity += (0.5 * step_s_) * state.acceleration;
  state.velocity.array() /= velocity_divisor_.array();
  state.acceleration -= damping_rate_.cwiseProduct(state.velocity);
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
