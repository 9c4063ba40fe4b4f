#pragma once

#include "lib/model/structure.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace impulse::newmark_contacts {

/// Two assembled bodies that meet pair by pair; body 1 arrives with the speed V.
struct Scene {
  const Structure& body_1;
  const Structure& body_2;
  double speed_m_per_s;
  std::vector<double> stiffness_N_per_m;  ///< of each contact, a spring that cannot pull
  std::vector<double> gaps_m;
};

struct History {
  std::vector<std::vector<double>> force_N;     ///< of each contact at the samples
  std::vector<std::vector<double>> impulse_Ns;  ///< of each contact up to the samples
};

/// One body: Newmark's average acceleration, (M + h²K/4) v₁ = (M - h²K/4) v₀ - hK u₀ + hC F̄, u₁ = u₀ + h(v₀ + v₁)/2,
/// with dense matrices.
class Body {
 public:
  Body(const Structure& structure, double step_s)
      : h_(step_s), m_(structure.mass), k_(structure.stiffness), c_(structure.contacts) {
    solver_.compute(m_ + 0.25 * h_ * h_ * k_);
    u_ = v_ = Eigen::VectorXd::Zero(m_.rows());
  }
  /// What F̄ = 1 N adds to the displacements of the contacts at the step's end.
  [[nodiscard]] Eigen::MatrixXd flexibility() const { return 0.5 * h_ * h_ * c_.transpose() * solver_.solve(c_); }
  [[nodiscard]] Eigen::VectorXd free_displacement() const {
    return c_.transpose() * (u_ + 0.5 * h_ * (v_ + velocity(Eigen::VectorXd::Zero(c_.cols()))));
  }
  void step(const Eigen::VectorXd& mean_force) {
    const Eigen::VectorXd v = velocity(mean_force);
    u_ += 0.5 * h_ * (v_ + v);
    v_ = v;
  }

 private:
  [[nodiscard]] Eigen::VectorXd velocity(const Eigen::VectorXd& mean_force) const {
    return solver_.solve(m_ * v_ - 0.25 * h_ * h_ * (k_ * v_) - h_ * (k_ * u_) + h_ * (c_ * mean_force));
  }
  double h_;
  Eigen::MatrixXd m_, k_, c_;
  Eigen::LLT<Eigen::MatrixXd> solver_;
  Eigen::VectorXd u_, v_;
};

/// Complementarity step by step: a spring F = k max(α, 0) at both ends of the step and its mean in between; the
/// contacts are iterated until they agree.
inline History simulate(const Scene& scene, double step_s, std::size_t samples) {
  Body first(scene.body_1, step_s), second(scene.body_2, step_s);
  const Eigen::MatrixXd w = first.flexibility() + second.flexibility();
  const Eigen::Index p = w.rows();
  const std::vector<double> start(samples, 0.0);
  History history{std::vector(static_cast<std::size_t>(p), start), std::vector(static_cast<std::size_t>(p), start)};
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(p), force = mean, free(p);
  for (std::size_t n = 1; n < samples; ++n) {
    for (Eigen::Index i = 0; i < p; ++i)
      free[i] = scene.speed_m_per_s * static_cast<double>(n) * step_s - scene.gaps_m[static_cast<std::size_t>(i)];
    free -= first.free_displacement() + second.free_displacement();
    for (double change = 1; change > 1e-13 * mean.cwiseAbs().maxCoeff();) {
      change = 0;
      for (Eigen::Index i = 0; i < p; ++i) {
        const double alone = free[i] - w.row(i).dot(mean) + w(i, i) * mean[i];
        const double k = scene.stiffness_N_per_m[static_cast<std::size_t>(i)];
        double next = (force[i] + k * alone) / (2 + k * w(i, i));
        if (alone <= w(i, i) * next) next = 0.5 * force[i];
        change = std::max(change, std::abs(next - mean[i]));
        mean[i] = next;
      }
    }
    for (Eigen::Index i = 0; i < p; ++i) {
      const auto c = static_cast<std::size_t>(i);
      history.impulse_Ns[c][n] = history.impulse_Ns[c][n - 1] + step_s * mean[i];
      force[i] = std::max(0.0, 2 * mean[i] - force[i]);
      history.force_N[c][n] = force[i];
    }
    first.step(mean);
    second.step(mean);
  }
  return history;
}

}  // namespace impulse::newmark_contacts
