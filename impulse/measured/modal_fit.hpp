#pragma once

#include "impulse/measured/band_filter.hpp"

#include <cstddef>
#include <vector>

namespace impulse {

/// A mode of which λ = -decay + i·frequency: decay = ζω, frequency = ω√(1-ζ²), both rad/s.
struct FittedMode {
  double frequency = 0;
  double decay = 0;
  double amplitude = 0;  ///< φ² [1/kg]
  double amplitude_std = 0;
  double share = 0;  ///< ‖its samples‖/‖all samples‖

  [[nodiscard]] double angular_frequency() const;
  [[nodiscard]] double damping_ratio() const { return decay / angular_frequency(); }
};

struct ModalFit {
  std::vector<FittedMode> modes;
  double rigid = 0;  ///< 1/m, where it is fitted
  double residual_norm = 0;
};

enum class RigidTerm { none, fitted };

/// Least squares fit of modes to filtered second differences of U: y_j = rigid + Σ p_m Re(c_m gain(z_m) z_m^(k_j)),
///
///   c = -(1 - i s/ω_d)(z - 2 + 1/z)/(ω²Δt²),   k_j = 1 + first + q j,
///
/// from starting poles, by Gauss-Newton with halved steps where the residual would grow. The standard deviations are
/// those of white noise of the residual's size. Verified by: tests/impulse/mode_identification.test.cpp
[[nodiscard]] ModalFit fitted_modes(const std::vector<double>& filtered, const BandFilter& filter, double step_s,
                                    std::vector<FittedMode> start, RigidTerm rigid);

}  // namespace impulse
