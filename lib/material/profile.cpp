#include "lib/material/profile.hpp"

#include "lib/cli/quantity.hpp"
#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace impulse {
namespace {

double disc_area(double diameter) { return std::numbers::pi / 4 * diameter * diameter; }

double specific_impedance(const Material& material) {
  return std::sqrt(material.youngs_modulus_Pa * material.density_kg_per_m3);
}

double positive_length(const std::string& text, const std::string& what) {
  double value = 0;
  try {
    value = parse_quantity(text, "m");
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{} {}", what, error.what()));
  }
  require(value > 0, "{} '{}' is not positive", what, text);
  return value;
}

void require_positive(double value, std::size_t segment, const char* what, const char* unit) {
  require(std::isfinite(value) && value > 0, "segment {}: {} {} {} is not positive and finite", segment, what, value,
          unit);
}

}  // namespace

double Segment::area_a_m2() const { return disc_area(diameter_a_m); }
double Segment::area_b_m2() const { return disc_area(diameter_b_m); }

double Segment::mass_kg() const {
  return std::numbers::pi / 12 * material.density_kg_per_m3 * length_m *
         (diameter_a_m * diameter_a_m + diameter_a_m * diameter_b_m + diameter_b_m * diameter_b_m);
}

double Segment::travel_time_s() const { return length_m / material.rod_wave_speed_m_per_s(); }
double Segment::impedance_a_kg_per_s() const { return area_a_m2() * specific_impedance(material); }
double Segment::impedance_b_kg_per_s() const { return area_b_m2() * specific_impedance(material); }

Profile reversed(const Profile& profile) {
  Profile result(profile.rbegin(), profile.rend());
  for (Segment& segment : result) std::swap(segment.diameter_a_m, segment.diameter_b_m);
  return result;
}

double mass_kg(const Profile& profile) {
  double sum = 0;
  for (const Segment& segment : profile) sum += segment.mass_kg();
  return sum;
}

double travel_time_s(const Profile& profile) {
  double sum = 0;
  for (const Segment& segment : profile) sum += segment.travel_time_s();
  return sum;
}

double face_impedance_kg_per_s(const Profile& profile, Face face) {
  require(!profile.empty(), "a bar without segments has no face");
  return face == Face::a ? profile.front().impedance_a_kg_per_s() : profile.back().impedance_b_kg_per_s();
}

void require_valid(const Bar& bar) {
  require(!bar.profile.empty(), "a bar needs at least one segment");
  for (std::size_t i = 0; i < bar.profile.size(); ++i) {
    const Segment& segment = bar.profile[i];
    require_positive(segment.length_m, i + 1, "length", "m");
    require_positive(segment.diameter_a_m, i + 1, "diameter at end A", "m");
    require_positive(segment.diameter_b_m, i + 1, "diameter at end B", "m");
    require_positive(segment.material.youngs_modulus_Pa, i + 1, "modulus", "Pa");
    require_positive(segment.material.density_kg_per_m3, i + 1, "density", "kg/m3");
  }
  require(!bar.faces.empty(), "a bar needs at least one contact face");
  require(bar.faces.size() <= 2, "a bar has two faces, not {}", bar.faces.size());
  if (bar.faces.size() == 2) {
    require(bar.faces[0] != bar.faces[1], "face {} is given twice", bar.faces[0] == Face::a ? "A" : "B");
    require(bar.far_end == FarEnd::free, "a bar in contact at both faces has no far end to hold; leave it free");
  }
}

Segment parse_segment(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else if (c != ' ' || !parts.back().empty())
      parts.back() += c;
  }
  require(parts.size() == 3 || parts.size() == 4,
          "segment '{}' has {} part{}; expected length,diameter,material or length,diameter,diameter,material such as "
          "400mm,30mm,75mm,nylon-6",
          text, parts.size(), parts.size() == 1 ? "" : "s");
  const bool cone = parts.size() == 4;
  Segment segment;
  segment.length_m = positive_length(parts[0], "length");
  segment.diameter_a_m = positive_length(parts[1], cone ? "first diameter" : "diameter");
  segment.diameter_b_m = cone ? positive_length(parts[2], "second diameter") : segment.diameter_a_m;
  segment.material = parse_material(parts.back());
  return segment;
}

}  // namespace impulse
