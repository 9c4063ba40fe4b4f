#pragma once

#include "impulse/response/wave_line.hpp"

#include <complex>

namespace impulse {

/// Velocity per unit force in the Laplace domain, at the struck end and (axially, away from the struck end) at the far
/// end.
template <class T>
struct EndMobility {
  T struck;
  T far;
};

/// Exact mobility of a line at s, Re s > 0. Cost: one complex exponential and a few divisions a piece.
[[nodiscard]] EndMobility<std::complex<double>> line_mobility(const WaveLine& line, std::complex<double> s);

/// The part of the same that pulse_train carries: the mobility as a series in q = 1/(s + μ), truncated, evaluated at s.
[[nodiscard]] EndMobility<std::complex<double>> line_pulse_mobility(const WaveLine& line, std::complex<double> s,
                                                                    double mu_per_s);

}  // namespace impulse
