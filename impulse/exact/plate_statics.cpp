#include "impulse/exact/plate_statics.hpp"

#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace impulse {
namespace {

using Complex = std::complex<double>;

/// γ and its derivative by y.
struct Green {
  Complex value, slope;
};

Green green(Complex k, double width, double at, double force) {
  const double low = std::min(at, force), high = width - std::max(at, force);
  // Of the hyperbolic functions only the quotients stay finite.
  const Complex scale = std::exp(-k * (width - low - high)) / (2.0 * k * (1.0 - std::exp(-2.0 * k * width)));
  const Complex e_low = std::exp(-2.0 * k * low), e_high = std::exp(-2.0 * k * high);
  const Complex slope = at < force ? (1.0 + e_low) * (1.0 - e_high) : -(1.0 - e_low) * (1.0 + e_high);
  return {scale * (1.0 - e_low) * (1.0 - e_high), scale * k * slope};
}

}  // namespace

PlateStatics simply_supported_plate_statics(const Laminate& laminate, double length_m, double width_m,
                                            const Eigen::Vector2d& force, const Eigen::Vector2d& point) {
  const Eigen::Matrix3d& d = laminate.bending;
  require(laminate.coupling.isZero(0) && std::abs(d(0, 2)) + std::abs(d(1, 2)) <= 1e-12 * d.norm(),
          "the laminate is coupled (B, D16 or D26): Navier's plate is specially orthotropic");
  for (const Eigen::Vector2d& p : {force, point})
    require(p.x() >= 0 && p.x() <= length_m && p.y() >= 0 && p.y() <= width_m,
            "the point ({} m, {} m) is outside the plate", p.x(), p.y());
  require(force.y() != point.y(), "on the force's line along x the curvatures don't converge");
  const double mixed = (d(0, 1) + 2 * d(2, 2)) / d(1, 1);
  Complex root = std::sqrt(Complex(mixed * mixed - d(0, 0) / d(1, 1)));
  // Where the roots coincide they are parted, which changes the answer by the square of this.
  if (std::abs(root) < 1e-4 * mixed) root = 1e-4 * mixed;
  PlateStatics sum{0, Eigen::Vector3d::Zero()};
  const double distance = std::abs(force.y() - point.y());
  const double slowest = std::sqrt(mixed - root).real(), digits = 40;
  const int terms = static_cast<int>(digits * length_m / (std::numbers::pi * slowest * distance)) + 2;
  for (int m = 1; m <= terms; ++m) {
    const double alpha = m * std::numbers::pi / length_m;
    const Complex k1 = alpha * std::sqrt(mixed + root), k2 = alpha * std::sqrt(mixed - root);
    const Complex apart = d(1, 1) * (k1 * k1 - k2 * k2);
    const Green g1 = green(k1, width_m, point.y(), force.y()), g2 = green(k2, width_m, point.y(), force.y());
    const double wave = 2 / length_m * std::sin(alpha * force.x()), sine = wave * std::sin(alpha * point.x()),
                 cosine = wave * std::cos(alpha * point.x());
    const double value = ((g2.value - g1.value) / apart).real(), slope = ((g2.slope - g1.slope) / apart).real();
    const double bend = ((k2 * k2 * g2.value - k1 * k1 * g1.value) / apart).real();
    sum.deflection_m_per_N += sine * value;
    sum.curvature_per_Nm += Eigen::Vector3d(alpha * alpha * sine * value, -sine * bend, -2 * alpha * cosine * slope);
  }
  return sum;
}

}  // namespace impulse
