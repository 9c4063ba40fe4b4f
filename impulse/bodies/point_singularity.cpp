#include "impulse/bodies/point_singularity.hpp"

#include "lib/contract/require.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace impulse {
namespace {

// 1/L of carbon plies, the sharpest there are, is resolved to rounding by 64 directions of a half turn.
constexpr int direction_count = 96;

/// Mean of ln|cos φ| against the trigonometric interpolant of what it is multiplied by: its Fourier series
/// -ln 2 - Σ (-1)ᵏ cos(2kφ)/k up to the modes that the directions hold.
double log_cosine(double cosine, double sine) {
  const std::complex<double> twice(cosine * cosine - sine * sine, 2 * cosine * sine);
  std::complex<double> power = 1;
  double sum = -std::numbers::ln2;
  for (int k = 1; k < direction_count / 2; ++k) {
    power *= -twice;
    sum -= power.real() / k;
  }
  return sum;
}

}  // namespace

PointSingularity::PointSingularity(const Laminate& laminate) {
  for (int j = 0; j < direction_count; ++j) {
    const double angle = std::numbers::pi * j / direction_count, c = std::cos(angle), s = std::sin(angle);
    Eigen::Matrix<double, 3, 2> stretch;
    stretch << c, 0, 0, s, s, c;
    const Eigen::Vector2d e(c, s);
    const Eigen::Vector3d p = stretch * e;
    const Eigen::Matrix2d a = stretch.transpose() * laminate.extension * stretch;
    const Eigen::Vector2d b = stretch.transpose() * laminate.coupling * p, in_plane = a.ldlt().solve(b);
    const double stiffness = p.dot(laminate.bending * p) - b.dot(in_plane);
    const double weight = 1 / (4 * std::numbers::pi * direction_count * stiffness);
    waves_.push_back({e, weight, weight * in_plane});
  }
}

Eigen::Matrix<double, 3, derivative_count> PointSingularity::at(const Eigen::Vector2d& offset_m) const {
  const double r = offset_m.norm();
  require(r > 0, "at the force itself the curvature is infinite");
  const Eigen::Vector2d ray = offset_m / r;
  Eigen::Matrix<double, 3, derivative_count> f = Eigen::Matrix<double, 3, derivative_count>::Zero();
  for (const Wave& wave : waves_) {
    const Eigen::Vector2d& e = wave.direction;
    const double cosine = ray.dot(e), t = r * cosine;
    const double log_t = std::log(r) + log_cosine(cosine, ray.x() * e.y() - ray.y() * e.x());
    const double value = t * t * log_t, slope = t * (2 * log_t + 1), bend = 2 * log_t + 3;
    f.row(2) +=
        wave.w * Eigen::Matrix<double, 1, derivative_count>(value, slope * e.x(), slope * e.y(), bend * e.x() * e.x(),
                                                            bend * e.x() * e.y(), bend * e.y() * e.y());
    f.block<2, 3>(0, 0) += wave.in_plane * Eigen::RowVector3d(slope, bend * e.x(), bend * e.y());
  }
  return f;
}

}  // namespace impulse
