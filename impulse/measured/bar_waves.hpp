#pragma once

#include "impulse/exact/pochhammer_chree.hpp"
#include "lib/material/material.hpp"
#include "lib/series/uniform_series.hpp"

#include <complex>
#include <optional>
#include <vector>

namespace impulse {

enum class Dispersion { none, pochhammer_chree };

/// A round bar as its first longitudinal mode sees it: phase velocity c(ω), c0 = √(E/ρ) if Dispersion::none.
class WaveBar {
 public:
  /// For signals sampled every step_s. @throws std::invalid_argument unless diameter and step are positive, and, with
  /// dispersion, if the material has no Poisson's ratio.
  WaveBar(const Material& material, double diameter_m, Dispersion dispersion, double step_s);

  [[nodiscard]] double phase_velocity_m_per_s(double angular_frequency) const;
  [[nodiscard]] double wave_speed_m_per_s() const { return c0_; }  ///< c0
  [[nodiscard]] double impedance_kg_per_s() const { return density_ * area_ * c0_; }
  [[nodiscard]] double area_m2() const { return area_; }
  [[nodiscard]] double density_kg_per_m3() const { return density_; }

 private:
  double c0_;
  double density_;
  double area_;
  double radius_;
  std::optional<BarDispersion> table_;
};

/// One wave that travels along a bar, by its axial strain (tension positive), and what else it carries:
///
///   F = -ρ A c² ε (compression positive),   v = ∓ c ε, in the direction in which F is passed on: v = -c ε
///
/// for a wave that travels forwards, of every frequency with its own c. For c = c0 that is F = -E A ε = Z v.
/// Limits: the gauge's strain, on the surface, is taken for the mean over the section, which holds for wavelengths
/// above some five diameters; one mode, so frequencies below the second mode's (about ωa/c0 = 3).
struct StrainWave {
  UniformGrid grid;
  std::vector<double> strain;
};

/// The wave after `distance_m` more of the bar (negative: before), ε̂ e^(-iωd/c(ω)), as a function of the same time; the
/// record is followed by as many zeros, so that what leaves it does not come back in at its other end for |d| < c T.
/// Error: rounding, for a pulse that is over by the record's end. Cost: two transforms of twice the length.
/// Verified by: tests/impulse/bar_waves.test.cpp
[[nodiscard]] StrainWave travelled(const StrainWave& wave, const WaveBar& bar, double distance_m);

/// Force (compression positive) of a strain wave, and the strain of a force wave.
/// Verified by: tests/impulse/bar_waves.test.cpp
[[nodiscard]] std::vector<double> wave_force_N(const StrainWave& wave, const WaveBar& bar);
[[nodiscard]] StrainWave strain_of_force(const UniformSeries& force_N, const WaveBar& bar);
/// -c ε: velocity, in the direction of travel.
[[nodiscard]] std::vector<double> wave_velocity_m_per_s(const StrainWave& wave, const WaveBar& bar);

/// Both waves at one end of a bar: arriving at it and leaving it, and the whole force and velocity there.
struct EndWaves {
  StrainWave arriving;
  StrainWave leaving;

  [[nodiscard]] std::vector<double> force_N(const WaveBar& bar) const;
  /// Positive out of the bar, in the direction of the arriving wave.
  [[nodiscard]] std::vector<double> velocity_m_per_s(const WaveBar& bar) const;
};

/// One gauge, `distance_m` from the end, where the arriving wave is over at `split_s` and the leaving one not yet
/// there.
/// @throws std::invalid_argument unless the split lies inside the record. Verified by: tests/impulse/bar_waves.test.cpp
[[nodiscard]] EndWaves separated_at(const StrainWave& gauge, const WaveBar& bar, double distance_m, double split_s);

/// Two gauges at distances d < D from the end (in either order), whatever overlaps at either, of a bar at rest at
/// first:
///
///   P = Σ_m e^(-2ikm(D-d)) [ε_D e^(-ikD) - ε_d e^(-ik(2D-d))],
///   N = Σ_m e^(-2ikm(D-d)) [ε_d e^(ikd)  - ε_D e^(-ik(D-2d))],   k = ω/c(ω),
///
/// P arriving at and N leaving the end, over as many passages m between the gauges as the record has time for: the
/// quotients by 1 - e^(-2ik(D-d)) of a bar at rest before, without the frequencies at which that vanishes.
/// Error: some 1e-10 of the strain a passage, but for N in the last d/c of the record, which gauge d has not seen yet.
/// Noise of the gauges adds up over the passages: after n of them its power is 2n + 1 to 2n + 2 times that of a gauge, so gauges
/// stand as far apart as the bar allows. Cost: four transforms of four times the length.
/// @throws std::invalid_argument for equal distances or grids that differ. Verified by:
/// tests/impulse/bar_waves.test.cpp
[[nodiscard]] EndWaves separated_by_two(const StrainWave& gauge_1, const StrainWave& gauge_2, const WaveBar& bar,
                                        double distance_1_m, double distance_2_m);

/// How a bridge turns strain into volts: U = U_ex · gain · k · (arms/4) · ε, in the linear range.
struct StrainBridge {
  double gauge_factor = 0;
  double excitation_V = 0;
  double gain = 1;
  double active_arms = 1;  ///< 1 quarter; 2 half or two opposite gauges; 2(1 + ν) full with transverse gauges; 4 full
};
/// Strain per volt. @throws std::invalid_argument unless all four are positive.
[[nodiscard]] double strain_per_volt(const StrainBridge& bridge);

/// What an arriving pulse of force says about the striker that made it.
struct StrikerPulse {
  double plateau_force_N = 0;  ///< mean over the middle half of the pulse
  double begin_s = 0;          ///< first crossing of half the plateau
  double length_s = 0;         ///< between the crossings of half the plateau
  double striker_speed_m_per_s = 0;
};
/// Speed of a striker of impedance Z_s from the plateau of its pulse in a bar of impedance Z: V = F (1/Z_s + 1/Z).
/// @throws std::invalid_argument if the force has no pulse. Verified by: tests/impulse/bar_waves.test.cpp
[[nodiscard]] StrikerPulse striker_pulse(const UniformSeries& force_N, double striker_impedance_kg_per_s,
                                         double bar_impedance_kg_per_s);

}  // namespace impulse
