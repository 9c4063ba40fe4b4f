#include "impulse/exact/beam_statics.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {
namespace {

double simple(double x, double y) {
  const double right = 1 - y;
  return x * right * (1 - x * x - right * right) / 6;
}

double clamped(double x, double y) {
  const double right = 1 - y;
  return x * x * right * right * (3 * y - x * (1 + 2 * y)) / 6;
}

double cantilever(double x, double y) { return x * x * (3 * y - x) / 6; }

double free_elastic(double x, double y) {
  const double s = x - 0.5, e = y - 0.5;
  const double left = 0.5 + e, right = 0.5 - e;
  const double fourth = std::pow(right, 4) + std::pow(left, 4);
  const double a = 11.0 / 1920 - fourth / 48;
  const double b = (std::pow(left, 5) - std::pow(right, 5)) / 5 - e * fourth / 4 + 3 * e / 1120 - 3 * e / 80;
  const double s2 = s * s;
  return std::pow(std::abs(s - e), 3) / 12 - s2 * s2 / 24 - e * s2 * s2 * s / 10 - s2 / 16 + e * s2 * s / 4 + a + b * s;
}

double influence(BeamSupports supports, double x, double y) {
  const auto [low, high] = std::minmax(x, y);
  switch (supports) {
    case BeamSupports::simple:
      return simple(low, high);
    case BeamSupports::clamped:
      return clamped(low, high);
    case BeamSupports::cantilever:
      return cantilever(low, high);
    default:
      return free_elastic(low, high);
  }
}

}  // namespace

Eigen::MatrixXd beam_static_flexibility(const Beam& beam) {
  require_valid(beam);
  const std::vector<double>& at = beam.contacts_at;
  const auto count = static_cast<Eigen::Index>(at.size());
  Eigen::MatrixXd flexibility(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      flexibility(i, j) = beam.flexibility_m_per_N() *
                          influence(beam.supports, at[static_cast<std::size_t>(i)], at[static_cast<std::size_t>(j)]);
  return flexibility;
}

}  // namespace impulse
