#pragma once

#include "lib/material/material.hpp"

#include <span>
#include <string>
#include <vector>

namespace impulse {

/// One piece of a bar between end A and end B: a cylinder, or a cone frustum whose diameter varies linearly.
struct Segment {
  double length_m = 0;
  double diameter_a_m = 0;
  double diameter_b_m = 0;
  Material material;

  [[nodiscard]] double area_a_m2() const;
  [[nodiscard]] double area_b_m2() const;
  [[nodiscard]] double mass_kg() const;
  [[nodiscard]] double travel_time_s() const;         ///< L/c, c = √(E/ρ)
  [[nodiscard]] double impedance_a_kg_per_s() const;  ///< Z = A√(Eρ) at end A
  [[nodiscard]] double impedance_b_kg_per_s() const;
};

/// Chain of segments from end A to end B.
using Profile = std::vector<Segment>;

enum class Face { a, b };
enum class FarEnd { free, fixed, infinite };

/// A bar with its contact faces and, if there is one contact face, what holds the other end.
/// `infinite`: beyond the far end the bar goes on for ever with the section and material that it has there.
struct Bar {
  Profile profile;
  std::vector<Face> faces{Face::a};
  FarEnd far_end = FarEnd::free;
};

/// The same chain seen from the other end.
[[nodiscard]] Profile reversed(const Profile& profile);

[[nodiscard]] double mass_kg(const Profile& profile);
[[nodiscard]] double travel_time_s(const Profile& profile);

/// Impedance Z = A√(Eρ) of the section at a face [kg/s].
[[nodiscard]] double face_impedance_kg_per_s(const Profile& profile, Face face);

/// @throws std::invalid_argument naming the segment (from 1) and the value, if the chain is empty, a length, diameter,
/// modulus or density is not positive and finite, a face is repeated or absent, or two faces have a far end other than
/// free.
void require_valid(const Bar& bar);

/// Reads `L,D,MATERIAL` (cylinder) or `L,D1,D2,MATERIAL` (cone) with units, `400mm,30mm,75mm,nylon-6`.
/// @throws std::invalid_argument naming the part that is wrong. Verified by: tests/lib/profile.test.cpp
[[nodiscard]] Segment parse_segment(const std::string& text);

}  // namespace impulse
