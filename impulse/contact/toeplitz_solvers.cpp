#include "impulse/contact/toeplitz_solvers.hpp"

#include "lib/contract/errors.hpp"
#include "lib/transform/power_series.hpp"
#include "lib/transform/real_fft.hpp"

#include <fmt/format.h>

#include <cmath>

namespace impulse {
namespace {

double largest_residual(std::span<const double> w, std::span<const double> b, std::span<const double> x) {
  const std::vector<double> product = convolution(w, x, b.size());
  double largest = 0;
  for (std::size_t k = 0; k < b.size(); ++k) {
    const double r = std::abs(b[k] - product[k]);
    largest = std::isfinite(r) ? std::max(largest, r) : HUGE_VAL;
  }
  return largest;
}

}  // namespace

std::vector<double> series_toeplitz(std::span<const double> w, std::span<const double> b, double tolerance) {
  PowerSeriesDivision division(b.size());
  PowerSeriesDivision::Result result = division.divide(b, w, tolerance);
  if (result.residual <= tolerance) return std::move(result.quotient);
  std::vector<double> marched = marched_toeplitz(w, b, [](auto) { return false; });
  const double residual = largest_residual(w, b, marched);
  if (!(residual <= tolerance))
    throw ConvergenceError(
        fmt::format("the discrete contact equation is left with a residual of {:.2g} m/s where {:.2g} was asked "
                    "(its kernel amplifies rounding); use a longer step or fewer modes",
                    residual, tolerance),
        tolerance, residual, result.refinements + 1);
  return marched;
}

std::vector<double> contour_toeplitz(std::span<const double> w, std::span<const double> b, double tolerance) {
  const std::size_t size = b.size();
  const double damping = 9.0 / static_cast<double>(size);
  const RealFft fft(fast_transform_size(4 * size));
  RealBuffer time(fft.size(), 0.0);
  ComplexBuffer numerator(fft.spectrum_size());
  ComplexBuffer denominator(fft.spectrum_size());
  for (std::size_t k = 0; k < size; ++k) time[k] = b[k] * std::exp(-damping * static_cast<double>(k));
  fft.forward(time, numerator);
  for (std::size_t k = 0; k < size; ++k) time[k] = w[k] * std::exp(-damping * static_cast<double>(k));
  fft.forward(time, denominator);
  for (std::size_t k = 0; k < numerator.size(); ++k) numerator[k] /= denominator[k];
  fft.inverse(numerator, time);
  std::vector<double> x(size);
  for (std::size_t k = 0; k < size; ++k) x[k] = time[k] * std::exp(damping * static_cast<double>(k));
  const double residual = largest_residual(w, b, x);
  if (!(residual <= tolerance))
    throw ConvergenceError(fmt::format("division on the shifted contour leaves a residual of {:.2g} m/s where {:.2g} "
                                       "was asked (the kernel rings or the record "
                                       "is cut off sharply); use --method product",
                                       residual, tolerance),
                           tolerance, residual, 1);
  return x;
}

}  // namespace impulse
