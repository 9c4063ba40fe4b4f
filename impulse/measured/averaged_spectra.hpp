#pragma once

#include "impulse/measured/least_squares_kernel.hpp"

#include <complex>
#include <span>
#include <vector>

namespace impulse {

/// Powers and cross power of B records, each transformed with as many zeros behind it:
///
///   S_ff = Σ|F_b|²,  S_vv = Σ|V_b|²,  S_fv = Σ F_b* V_b   at the frequencies k/(transform_size · step), k = 0 .. half.
///
/// Sums of squares of samples; their ratios are the system's, with no factor from the sampling.
struct AveragedSpectra {
  std::size_t record_count = 0;
  std::size_t record_size = 0;
  std::size_t transform_size = 0;
  std::vector<double> input_power;
  std::vector<double> output_power;
  std::vector<std::complex<double>> cross;

  [[nodiscard]] double largest_input_power() const;

  /// γ² = |S_fv|²/(S_ff S_vv): the share of the output's power that the input explains; 0 where either is 0.
  [[nodiscard]] std::vector<double> coherence() const;
};

/// @throws std::invalid_argument for no or unequal records. Verified by: tests/impulse/averaged_spectra.test.cpp
[[nodiscard]] AveragedSpectra averaged_spectra(std::span<const InputOutput> records);

/// λ (over the largest input power) of Tikhonov's regularisation X = S_fv/(S_ff + λ·penalty) that predicts best in
/// generalised cross-validation: least RSS(λ)/(n - Σ S_ff/(S_ff + λ·penalty))², n the number of samples, by a scan of
/// 1e-12 .. 1 and a refinement by golden section. Residuals and degrees of freedom per frequency, hence in one pass.
/// For noise that is white over the record. Verified by: tests/impulse/averaged_spectra.test.cpp
[[nodiscard]] double cross_validated_regularisation(const AveragedSpectra& spectra, Penalty penalty = Penalty::size);

/// λ at the corner (largest curvature) of log ‖residual‖² against log ‖x‖², over the same range.
/// Verified by: tests/impulse/averaged_spectra.test.cpp
[[nodiscard]] double l_curve_regularisation(const AveragedSpectra& spectra, Penalty penalty = Penalty::size);

/// Estimators of X = V/F over several records.
enum class SpectralEstimator {
  h1,  ///< S_fv/S_ff: noise on the output averages out
  h2,  ///< S_vv/S_fv*: noise on the input averages out
  hv,  ///< √(S_vv/S_ff) with the phase of S_fv: the geometric mean
};

/// Kernel by an average of spectra, each times S_ff/(S_ff + λ) (λ = regularisation × largest power, may be 0),
/// transformed back; what falls on negative times is dropped. Needs records that decay within their length, which an
/// exponential window gives them. Deviations: linearised bootstrap, as least_squares_kernel.
/// @throws std::invalid_argument for invalid records or λ < 0, or if an input has no power at a frequency and λ = 0.
/// Verified by: tests/impulse/averaged_spectra.test.cpp
[[nodiscard]] EstimatedKernel spectral_kernel(std::span<const InputOutput> records, const AveragedSpectra& spectra,
                                              SpectralEstimator estimator, double regularisation);

}  // namespace impulse
