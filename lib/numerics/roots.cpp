#include "lib/numerics/roots.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/numerics/gsl_status.hpp"

#include <gsl/gsl_math.h>
#include <gsl/gsl_roots.h>

#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <new>

namespace impulse {
namespace {

/// What GSL's C callback is given: an exception must not unwind through C frames, so it is kept here and rethrown.
struct Callback {
  const std::function<double(double)>& f;
  std::exception_ptr exception = nullptr;

  void rethrow() const {
    if (exception) std::rethrow_exception(exception);
  }
};

double call(double x, void* data) {
  auto& callback = *static_cast<Callback*>(data);
  if (callback.exception) return std::numeric_limits<double>::quiet_NaN();
  try {
    return callback.f(x);
  } catch (...) {
    callback.exception = std::current_exception();
    return std::numeric_limits<double>::quiet_NaN();  // GSL stops on it with GSL_EBADFUNC
  }
}

struct FreeSolver {
  void operator()(gsl_root_fsolver* solver) const { gsl_root_fsolver_free(solver); }
};

double root(const gsl_root_fsolver_type* method, const std::function<double(double)>& f, double low, double high,
            const RootTolerance& tolerance) {
  require(std::isfinite(low) && std::isfinite(high) && low <= high,
          "[{}, {}] is not an interval to search for a root; give finite bounds in ascending order", low, high);
  require(std::isfinite(tolerance.absolute) && tolerance.absolute >= 0,
          "the absolute tolerance of a root, {}, is negative or not finite", tolerance.absolute);
  require(std::isfinite(tolerance.relative) && tolerance.relative >= 0,
          "the relative tolerance of a root, {}, is negative or not finite", tolerance.relative);
  require(tolerance.max_iterations > 0, "{} iterations cannot find a root; allow at least one",
          tolerance.max_iterations);

  const double f_low = f(low);
  if (f_low == 0) return low;
  const double f_high = f(high);
  if (f_high == 0) return high;
  require(std::isfinite(f_low) && std::isfinite(f_high),
          "f({}) = {}, f({}) = {}: not finite at the ends of the bracket", low, f_low, high, f_high);
  require((f_low < 0) != (f_high < 0),
          "f({}) = {} and f({}) = {} have the same sign; the bracket must hold a change of sign", low, f_low, high,
          f_high);

  use_gsl_statuses();
  const std::unique_ptr<gsl_root_fsolver, FreeSolver> solver(gsl_root_fsolver_alloc(method));
  if (!solver) throw std::bad_alloc();
  Callback callback{f};
  gsl_function function{&call, &callback};
  int status = gsl_root_fsolver_set(solver.get(), &function, low, high);
  callback.rethrow();
  require(status == GSL_SUCCESS, "the root search in [{}, {}] cannot start: {}", low, high, gsl_strerror(status));

  // A bracket of a few roundings cannot shrink: below that, a relative tolerance could never be met.
  const double relative = std::fmax(tolerance.relative, 4 * std::numeric_limits<double>::epsilon());
  for (int iteration = 1; iteration <= tolerance.max_iterations; ++iteration) {
    status = gsl_root_fsolver_iterate(solver.get());
    callback.rethrow();
    const double x = gsl_root_fsolver_root(solver.get());
    const double left = gsl_root_fsolver_x_lower(solver.get());
    const double right = gsl_root_fsolver_x_upper(solver.get());
    require(status != GSL_EBADFUNC, "f is not finite inside [{}, {}], where a root is sought", left, right);
    if (status != GSL_SUCCESS)
      throw ConvergenceError(fmt::format("the root search stopped near {}: {}", x, gsl_strerror(status)), relative,
                             right - left, static_cast<std::size_t>(iteration));
    if (left == right || right - left <= tolerance.absolute + relative * std::fabs(x)) return x;
  }
  const double width = gsl_root_fsolver_x_upper(solver.get()) - gsl_root_fsolver_x_lower(solver.get());
  const double x = gsl_root_fsolver_root(solver.get());
  throw ConvergenceError(
      fmt::format(
          "the root near {} is known within {} only after {} iterations; allow more iterations or a larger tolerance",
          x, width, tolerance.max_iterations),
      tolerance.absolute + relative * std::fabs(x), width, static_cast<std::size_t>(tolerance.max_iterations));
}

}  // namespace

double bracketed_root(const std::function<double(double)>& f, double low, double high, const RootTolerance& tolerance) {
  return root(gsl_root_fsolver_brent, f, low, high, tolerance);
}

double bisected_root(const std::function<double(double)>& f, double low, double high, const RootTolerance& tolerance) {
  return root(gsl_root_fsolver_bisection, f, low, high, tolerance);
}

}  // namespace impulse
