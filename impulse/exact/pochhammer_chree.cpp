#include "impulse/exact/pochhammer_chree.hpp"

#include "lib/contract/require.hpp"
#include "lib/numerics/bessel.hpp"
#include "lib/numerics/roots.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace impulse {
namespace {

/// Squared speeds over c0²: of shear waves, and the inverse of that of dilatational waves (0 for ν = 0.5).
struct BulkWaves {
  double shear = 0;
  double inverse_dilatational = 0;
};

BulkWaves bulk_waves(double nu) {
  require(nu >= 0 && nu <= 0.5, "Poisson's ratio {} is outside [0, 0.5]", nu);
  return {0.5 / (1 + nu), (1 + nu) * (1 - 2 * nu) / (1 - nu)};
}

/// The frequency equation over q a³ k⁴, in K = (ka)², P = (pa)², Q = (qa)².
double frequency_equation(double ratio, double K, const BulkWaves& bulk) {
  const double P = K * (ratio * ratio * bulk.inverse_dilatational - 1);
  const double Q = K * (ratio * ratio / bulk.shear - 1);
  const BesselPair p = scaled_bessel_pair(P);
  const BesselPair q = scaled_bessel_pair(Q);
  return (2 * P * (Q + K) * p.first * q.first - (Q - K) * (Q - K) * p.zeroth * q.first -
          4 * K * P * p.first * q.zeroth) /
         (K * K);
}

/// c/c0 at which qa = x.
double ratio_at(double x, double K, const BulkWaves& bulk) { return std::sqrt(bulk.shear * (1 + x * x / K)); }

}  // namespace

double rayleigh_speed_ratio(double poissons_ratio) {
  const BulkWaves bulk = bulk_waves(poissons_ratio);
  // (2 - s)² = 4 √(1 - s) √(1 - s c_T²/c_L²), s = (c/c_T)²; s = 0 is a root too, and s lies in (0.76, 0.92).
  const auto equation = [&](double s) {
    return (2 - s) * (2 - s) - 4 * std::sqrt(1 - s) * std::sqrt(1 - s * bulk.shear * bulk.inverse_dilatational);
  };
  return std::sqrt(bulk.shear * bracketed_root(equation, 0.5, 1));
}

double pochhammer_chree_speed_ratio(double radius_wave_number, double poissons_ratio) {
  const double kappa = radius_wave_number;
  require(std::isfinite(kappa) && kappa >= 0, "wave number times radius {} is negative or not finite", kappa);
  const BulkWaves bulk = bulk_waves(poissons_ratio);
  // Rayleigh's correction is exact to rounding here, where the equation has lost its digits.
  if (kappa < 1e-3) return 1 - std::pow(poissons_ratio * kappa / 2, 2);

  const double K = kappa * kappa;
  const auto equation = [&](double ratio) { return frequency_equation(ratio, K, bulk); };
  double low = 0.9 * rayleigh_speed_ratio(poissons_ratio);
  double high = std::sqrt(bulk.shear);
  const bool below_zero = equation(low) < 0;
  if ((equation(high) < 0) != below_zero) return bracketed_root(equation, low, high);
  // The first root above c_T. Other modes come down to c_T too; roots lie about π apart in qa.
  const double end = 1 + 1e-6;  // past c0 by more than rounding, since for ν = 0 the root is c0 itself
  for (double x = 0; high < end;) {
    low = high;
    x += 0.25;
    high = std::min(end, ratio_at(x, K, bulk));
    if ((equation(high) < 0) != below_zero) return bracketed_root(equation, low, high);
  }
  return 1;
}

namespace {

CubicSpline dispersion_spline(double poissons_ratio, double highest) {
  require(std::isfinite(highest) && highest > 0, "the highest frequency, ωa/c0 = {}, is not positive", highest);
  // A natural spline's error at its ends decays by 0.27 a point: the even curve is continued beyond both.
  constexpr int margin = 20;
  constexpr double finest = 0.01;
  std::vector<double> frequency;
  std::vector<double> ratio;
  const auto add = [&](double kappa) {
    ratio.push_back(pochhammer_chree_speed_ratio(std::abs(kappa), poissons_ratio));
    frequency.push_back(kappa * ratio.back());
  };
  for (int k = -margin; k <= 0; ++k) add(finest * k);
  int beyond = 0;
  for (double kappa = 0; beyond<margin; beyond += frequency.back()> highest ? 1 : 0) {
    kappa += std::max(finest, kappa / 300);
    add(kappa);
  }
  return {std::move(frequency), std::move(ratio)};
}

}  // namespace

BarDispersion::BarDispersion(double poissons_ratio, double highest_radius_frequency)
    : spline_(dispersion_spline(poissons_ratio, highest_radius_frequency)) {}

double BarDispersion::speed_ratio(double radius_frequency) const {
  require(radius_frequency >= 0, "the frequency ωa/c0 = {} is negative", radius_frequency);
  return spline_(radius_frequency);
}

}  // namespace impulse
