#pragma once

#include "impulse/response/truncated_series.hpp"
#include "impulse/response/wave_line.hpp"

#include <cstddef>
#include <vector>

namespace impulse {

/// What arrives at an end at one time: velocity per unit impulse Σ a_k q^k, q = 1/(s + μ): a Dirac pulse of weight a₀
/// [m/(N s)] and, behind it, Σ a_k t^(k-1) e^(-μt)/(k-1)!.
struct Pulse {
  double time_s;
  TruncatedSeries<double> velocity;
};

/// All pulses up to a duration at the struck end and, axially away from the struck end, at the far end.
struct PulseTrain {
  double mu_per_s;
  std::vector<Pulse> at_struck_end;
  std::vector<Pulse> at_far_end;
};

/// Follows the wave fronts of a unit impulse on the struck end through every reflection and transmission, in order of
/// time; fronts that meet at one place and time are merged, so that their number grows as a power of the duration, not
/// exponentially. Times are whole multiples of duration/2^50. Where more than 100,000 fronts are under way at once (many
/// incommensurate segments), fronts below a threshold that rises as needed are put on a lattice of step/8 by cubic
/// interpolation, which preserves their moments up to the third; each is off by at most its own size within two lattice
/// steps of its arrival. Verified by: tests/impulse/wave_response.test.cpp
[[nodiscard]] PulseTrain pulse_train(const WaveLine& line, double duration_s, double step_s, double mu_per_s);

}  // namespace impulse
