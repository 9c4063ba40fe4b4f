#include "lib/numerics/cubic_spline.hpp"

#include "lib/contract/require.hpp"
#include "lib/numerics/gsl_status.hpp"

#include <gsl/gsl_spline.h>

#include <algorithm>

namespace impulse {

struct CubicSpline::Spline {
  struct Free {
    void operator()(gsl_spline* spline) const { gsl_spline_free(spline); }
  };
  std::unique_ptr<gsl_spline, Free> spline;
};

CubicSpline::CubicSpline(std::vector<double> x, std::vector<double> y) {
  require(x.size() >= 3 && x.size() == y.size(), "{} abscissas and {} ordinates make no spline; it takes three points",
          x.size(), y.size());
  require(std::ranges::adjacent_find(x, std::greater_equal{}) == x.end(), "the abscissas of a spline must ascend");
  use_gsl_statuses();
  auto spline = std::make_shared<Spline>();
  spline->spline.reset(gsl_spline_alloc(gsl_interp_cspline, x.size()));
  if (!spline->spline) throw std::bad_alloc();
  const int status = gsl_spline_init(spline->spline.get(), x.data(), y.data(), x.size());
  require(status == GSL_SUCCESS, "no spline through these points: {}", gsl_strerror(status));
  first_ = x.front();
  last_ = x.back();
  spline_ = spline;
}

double CubicSpline::operator()(double x) const {
  require(x >= first_ && x <= last_, "{} lies outside the spline's points, [{}, {}]", x, first_, last_);
  // No accelerator: it is state that threads would share, and a bisection is cheap.
  return gsl_spline_eval(spline_->spline.get(), x, nullptr);
}

}  // namespace impulse
