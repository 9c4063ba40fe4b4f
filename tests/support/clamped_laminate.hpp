#pragma once

#include "lib/material/laminate.hpp"
#include "lib/numerics/quadrature.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <cstddef>
#include <vector>

namespace impulse::test {

/// Clamped square laminate 0 ≤ |X|, |Y| ≤ side/2 under pressure by von Kármán's strains and global polynomials,
///
///   w = (1-x²)²(1-y²)² Σ W T_2i(x) T_2j(y),  u = (1-x²)(1-y²) Σ U T_2i+1(x) T_2j(y),  v likewise,  x = 2X/side
///
/// count² of each, so that `count` 3 is of order 8: what a cross-ply's symmetry leaves. Dense, no element, no mesh.
class ClampedLaminate {
 public:
  ClampedLaminate(const Laminate& laminate, double side_m, int count) : count_(count), scale_(2 / side_m) {
    rigidity_ << laminate.extension, laminate.coupling, laminate.coupling, laminate.bending;
    // Exact: the membrane energy's degree is 8 count + 4.
    const QuadratureRule rule = gauss_legendre(static_cast<std::size_t>(4 * count + 4));
    for (Eigen::Index i = 0; i < rule.points.size(); ++i)
      for (Eigen::Index j = 0; j < rule.points.size(); ++j)
        if (rule.points(i) > 0 && rule.points(j) > 0)
          points_.push_back({gradients(rule.points(i), rule.points(j)), values(rule.points(i), rule.points(j)),
                             4 * rule.weights(i) * rule.weights(j) / (scale_ * scale_)});
  }

  /// In the middle, at rest, by Newton's method in four equal steps of the load.
  [[nodiscard]] double deflection_m(double pressure_Pa) const {
    const Eigen::VectorXd middle = values(0, 0);
    Eigen::VectorXd z = Eigen::VectorXd::Zero(3 * count_ * count_);
    for (int part = 1; part <= 4; ++part)
      for (double change = 1; std::abs(change) > 1e-12;) {
        const Eigen::VectorXd step = newton_step(z, pressure_Pa * part / 4);
        z += step;
        change = middle.dot(step) / middle.dot(z);
      }
    return middle.dot(z);
  }

 private:
  using Gradients = Eigen::Matrix<double, 9, Eigen::Dynamic>;  ///< rows u_x u_y v_x v_y w_x w_y w_xx w_yy w_xy
  struct Point {
    Gradients gradients;
    Eigen::VectorXd values;  ///< of w
    double weight;
  };
  struct Factor {
    double value, first, second;
  };

  /// (1 - x²)^power T_k(x), by T_k+1 = 2x T_k - T_k-1 and its derivatives.
  static Factor factor(int power, int k, double x) {
    Factor before{1, 0, 0}, t{x, 1, 0};
    if (k == 0) t = before;
    for (int i = 1; i < k; ++i) {
      const Factor next{2 * x * t.value - before.value, 2 * t.value + 2 * x * t.first - before.first,
                        4 * t.first + 2 * x * t.second - before.second};
      before = t;
      t = next;
    }
    const double s = 1 - x * x;
    const Factor b = power == 1 ? Factor{s, -2 * x, -2} : Factor{s * s, -4 * x * s, 8 * x * x - 4 * s};
    return {b.value * t.value, b.first * t.value + b.value * t.first,
            b.second * t.value + 2 * b.first * t.first + b.value * t.second};
  }

  [[nodiscard]] Eigen::VectorXd values(double x, double y) const {
    Eigen::VectorXd w = Eigen::VectorXd::Zero(3 * count_ * count_);
    for (int i = 0, k = 2 * count_ * count_; i < count_; ++i)
      for (int j = 0; j < count_; ++j, ++k) w(k) = factor(2, 2 * i, x).value * factor(2, 2 * j, y).value;
    return w;
  }

  [[nodiscard]] Gradients gradients(double x, double y) const {
    Gradients g = Gradients::Zero(9, 3 * count_ * count_);
    for (int i = 0, k = 0; i < count_; ++i)
      for (int j = 0; j < count_; ++j, ++k) {
        const int all = count_ * count_;
        const Factor ux = factor(1, 2 * i + 1, x), uy = factor(1, 2 * j, y), vx = factor(1, 2 * i, x),
                     vy = factor(1, 2 * j + 1, y), wx = factor(2, 2 * i, x), wy = factor(2, 2 * j, y);
        g.block<2, 1>(0, k) << ux.first * uy.value, ux.value * uy.first;
        g.block<2, 1>(2, all + k) << vx.first * vy.value, vx.value * vy.first;
        g.block<2, 1>(4, 2 * all + k) << wx.first * wy.value, wx.value * wy.first;
        g.block<3, 1>(6, 2 * all + k) << wx.second * wy.value, wx.value * wy.second, wx.first * wy.first;
      }
    g.topRows<6>() *= scale_;
    g.bottomRows<3>() *= scale_ * scale_;
    return g;
  }

  [[nodiscard]] Eigen::VectorXd newton_step(const Eigen::VectorXd& z, double pressure_Pa) const {
    Eigen::VectorXd unbalanced = Eigen::VectorXd::Zero(z.size());
    Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(z.size(), z.size());
    for (const Point& point : points_) {
      const Eigen::Matrix<double, 9, 1> g = point.gradients * z;
      Eigen::Matrix<double, 6, 1> strain;
      strain << g(0) + g(4) * g(4) / 2, g(3) + g(5) * g(5) / 2, g(1) + g(2) + g(4) * g(5), -g(6), -g(7), -2 * g(8);
      Eigen::Matrix<double, 6, 9> slope = Eigen::Matrix<double, 6, 9>::Zero();
      slope(0, 0) = slope(1, 3) = slope(2, 1) = slope(2, 2) = 1;
      slope(0, 4) = slope(2, 5) = g(4);
      slope(1, 5) = slope(2, 4) = g(5);
      slope.bottomRightCorner<3, 3>().diagonal() << -1, -1, -2;
      const Eigen::Matrix<double, 6, 1> stress = rigidity_ * strain;
      Eigen::Matrix<double, 9, 9> stiffness = slope.transpose() * rigidity_ * slope;
      stiffness.block<2, 2>(4, 4) += (Eigen::Matrix2d() << stress(0), stress(2), stress(2), stress(1)).finished();
      unbalanced +=
          point.weight * (pressure_Pa * point.values - point.gradients.transpose() * (slope.transpose() * stress));
      const Eigen::MatrixXd half = stiffness * point.gradients;
      tangent.noalias() += point.weight * point.gradients.transpose() * half;
    }
    return tangent.ldlt().solve(unbalanced);
  }

  int count_;
  double scale_;  ///< x = scale X
  Eigen::Matrix<double, 6, 6> rigidity_;
  std::vector<Point> points_;
};

}  // namespace impulse::test
