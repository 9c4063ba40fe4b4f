#include "lib/numerics/bessel.hpp"

#include "lib/contract/require.hpp"
#include "lib/numerics/gsl_status.hpp"

#include <gsl/gsl_sf_bessel.h>

#include <cmath>

namespace impulse {
namespace {

double value(int (*function)(double, gsl_sf_result*), double x) {
  gsl_sf_result result{};
  const int status = function(x, &result);
  // An underflow of J1(x) near x = 0 is the right answer to rounding.
  require(status == GSL_SUCCESS || status == GSL_EUNDRFLW, "no Bessel function of {}: {}", x, gsl_strerror(status));
  return result.val;
}

}  // namespace

BesselPair scaled_bessel_pair(double s) {
  require(std::isfinite(s), "no Bessel function of {}", s);
  use_gsl_statuses();
  const double x = std::sqrt(std::abs(s));
  // Two terms of both series are exact here.
  if (x < 1e-4) {
    const double scale = s < 0 ? std::exp(-x) : 1;
    return {scale * (1 - s / 4), scale * (0.5 - s / 16)};
  }
  if (s < 0) return {value(gsl_sf_bessel_I0_scaled_e, x), value(gsl_sf_bessel_I1_scaled_e, x) / x};
  return {value(gsl_sf_bessel_J0_e, x), value(gsl_sf_bessel_J1_e, x) / x};
}

}  // namespace impulse
