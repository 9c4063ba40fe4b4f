#pragma once

#include "impulse/measured/averaged_spectra.hpp"
#include "impulse/measured/blow.hpp"
#include "impulse/measured/bootstrap.hpp"
#include "impulse/measured/measured_response.hpp"

#include <optional>
#include <string>
#include <vector>

namespace impulse {

enum class ResponseEstimator { least_squares, h1, h2, hv };
enum class Drift {
  none,
  held,  ///< the body is at rest again at the end of the record, in the mean of its last tenth
  free   ///< it moves with impulse/mass
};

/// λ by which rule, or as it is given.
struct Regularisation {
  enum class Rule { cross_validation, l_curve, none, value } rule = Rule::cross_validation;
  double value = 0;  ///< over the largest power of the forces
};

struct EstimateOptions {
  ResponseEstimator estimator = ResponseEstimator::least_squares;
  Regularisation regularisation = {};
  BlowOptions blow = {};
  std::vector<BlowFault> accepted = {};      ///< faults that do not leave a blow out
  std::optional<double> exponential_s = {};  ///< time constant of an exponential window on both channels
  std::optional<double> free_mass_kg = {};   ///< of a free body: 1/m is the rigid-body part of G
  Drift drift = Drift::none;
  std::optional<Bootstrap> bootstrap = {};  ///< deviations by resampling; empty: in closed form
  std::optional<double> duration_s = {};    ///< of the response; empty: what the shortest record leaves
};

struct LeftOut {
  std::string name;
  BlowFault fault;
};

/// A response and how it came about.
struct ResponseEstimate {
  MeasuredResponse measured;
  std::vector<LeftOut> left_out;
  std::size_t blow_count = 0;
  double regularisation = 0;  ///< λ over the largest power
  double force_window_s = 0;  ///< the longest
  AveragedSpectra spectra;    ///< of the blows as windowed
};

/// Response of a body from blows on it, force in N and velocity in m/s, before each of which it was at rest.
///
/// Each blow is cut from just before its pulse; its force is taken for zero beyond its window. Least squares in the
/// time domain (least_squares_kernel.hpp) or an average of spectra then gives the weights of the contact equation, and
/// they the response (measured_response.hpp). An exponential window multiplies force and velocity by e^(-t/τ), hence
/// the kernel too, from which it is divided out again: it adds no damping. A response ends where the last force window
/// would leave it undetermined. A bootstrap draws blows; λ in units of the forces' power, and the windows, stay those
/// of the whole test.
/// @throws std::invalid_argument if no blow is left, saying why each was left out, or if options contradict each other;
/// ConvergenceError. Verified by: tests/impulse/response_estimate.test.cpp,
/// tests/impulse/response_coverage.test.cpp
[[nodiscard]] ResponseEstimate estimated_response(const std::vector<Blow>& blows, double step_s,
                                                  const EstimateOptions& options);

}  // namespace impulse
