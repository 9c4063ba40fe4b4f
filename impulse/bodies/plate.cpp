#include "impulse/bodies/plate.hpp"

#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace impulse {
namespace {

HeldEdge held_edge(char letter, const std::string& letters) {
  switch (letter) {
    case 'C':
      return {true, true, true, true, true};
    case 'F':
      return {};
    case 'I':
      return {true, true, true, false, false};
    case 'H':
      return {true, true, true, false, true};
    case 'S':
      return {true, true, false, false, true};
    case 'T':
      return {true, false, true, false, true};
    case 'W':
      return {true, false, false, false, false};
    default:
      throw std::invalid_argument(fmt::format("edges '{}': '{}' is none of C, F, I, H, S, T, W", letters, letter));
  }
}

double length_along_y(const PlateShape& shape) {
  const auto [least, most] = std::ranges::minmax(shape.corners, {}, [](const Eigen::Vector2d& c) { return c.y(); });
  return most.y() - least.y();
}

}  // namespace

std::array<HeldEdge, 4> parse_plate_edges(const std::string& letters) {
  require(letters.size() == 4, "edges '{}' are {}, not four letters such as SSSS", letters, letters.size());
  std::array<HeldEdge, 4> edges;
  for (std::size_t i = 0; i < 4; ++i) edges[i] = held_edge(letters[i], letters);
  return edges;
}

double mass_kg(const Plate& plate) { return plate.laminate.mass_kg_per_m2 * std::abs(plate.shape.signed_area()); }

bool moves_in_plane(const Plate& plate) {
  const bool by_inertia = plate.theory == Plate::Theory::shear && plate.laminate.mass_moment_kg_per_m != 0;
  return plate.in_plane == Plate::InPlane::always || plate.curvature_per_m != 0 || by_inertia ||
         !plate.laminate.coupling.isZero(0);
}

void require_valid(const Plate& plate) {
  require_valid(plate.shape);
  require(plate.laminate.thickness_m > 0 && plate.laminate.mass_kg_per_m2 > 0,
          "the plate has the thickness {} m and the mass {} kg/m2; give it a laminate", plate.laminate.thickness_m,
          plate.laminate.mass_kg_per_m2);
  require(std::isfinite(plate.shear_correction) && plate.shear_correction > 0,
          "the shear correction factor {} is not positive and finite", plate.shear_correction);
  require(std::isfinite(plate.curvature_per_m), "the curvature {} 1/m is not finite", plate.curvature_per_m);
  const double turn = std::abs(plate.curvature_per_m) * length_along_y(plate.shape);
  require(turn < 2 * std::numbers::pi,
          "a panel of {:.4g} m along y goes round its radius of {:.4g} m once or more; use more than {:.4g} m",
          length_along_y(plate.shape), 1 / std::abs(plate.curvature_per_m),
          length_along_y(plate.shape) / (2 * std::numbers::pi));
  for (std::size_t i = 0; i < 4; ++i) {
    const EdgeSprings& s = plate.springs[i];
    for (const double k : {s.deflection_N_per_m2, s.normal_displacement_N_per_m2, s.tangential_displacement_N_per_m2,
                           s.normal_rotation_N, s.tangential_rotation_N})
      require(std::isfinite(k) && k >= 0, "a spring of edge {} has the stiffness {}, negative or not finite", i + 1, k);
  }
}

}  // namespace impulse
