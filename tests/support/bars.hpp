#pragma once

#include "lib/material/profile.hpp"

#include <cstddef>
#include <utility>
#include <vector>

/// The bodies of the four published cases and some that have simple answers.
namespace impulse::bars {

inline Bar cone(Face face = Face::a) { return {{parse_segment("400mm,30mm,75mm,nylon-6")}, {face}, FarEnd::free}; }

inline Bar composite(Face face = Face::a) {
  const Segment nylon = parse_segment("125mm,32mm,nylon-6");
  const Segment aluminium = parse_segment("125mm,32mm,aluminium");
  return {{nylon, aluminium, nylon, aluminium}, {face}, FarEnd::free};
}

inline Bar long_rod() { return {{parse_segment("6150mm,10mm,steel")}, {Face::a}, FarEnd::free}; }

inline Bar steel_rod(double length_m, FarEnd far_end = FarEnd::free, double diameter_m = 0.010) {
  return {{{length_m, diameter_m, diameter_m, parse_material("steel")}}, {Face::a}, far_end};
}

/// A steel rod that a wave crosses in `cells` steps.
inline Bar rod_of_cells(std::size_t cells, double step_s, double diameter_m, std::vector<Face> faces,
                        FarEnd far_end = FarEnd::free) {
  const Material steel = parse_material("steel");
  return {{{static_cast<double>(cells) * step_s * steel.rod_wave_speed_m_per_s(), diameter_m, diameter_m, steel}},
          std::move(faces),
          far_end};
}

/// At end A [kg/s].
inline double impedance(const Bar& bar) { return face_impedance_kg_per_s(bar.profile, Face::a); }

}  // namespace impulse::bars
