#pragma once

#include "lib/material/beam.hpp"

namespace impulse::beams {

/// Timoshenko's: 1 cm square and 15.35 cm long, of a steel that makes the first period 1 ms.
inline Beam timoshenko(BeamSupports supports = BeamSupports::simple, std::vector<double> at = {0.5}) {
  return {0.1535, 0.01, 0.01, parse_material("215.75GPa:7960kg/m3:0.3"), supports, std::move(at)};
}

inline constexpr BeamSupports all_supports[] = {BeamSupports::simple, BeamSupports::clamped, BeamSupports::cantilever,
                                                BeamSupports::free};

}  // namespace impulse::beams
