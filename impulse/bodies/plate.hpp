#pragma once

#include "impulse/bodies/plate_shape.hpp"
#include "lib/material/laminate.hpp"

#include <array>
#include <cstddef>
#include <string>

namespace impulse {

/// What an edge holds at zero: the deflection w, the displacement in the plane normal to the edge and along it, and the
/// rotation φ of the normal in the same two directions (φ normal to the edge is bending about the edge).
struct HeldEdge {
  bool deflection = false;
  bool normal_displacement = false;
  bool tangential_displacement = false;
  bool normal_rotation = false;
  bool tangential_rotation = false;
};

/// Springs along an edge, in the directions of HeldEdge, per unit length of the edge.
struct EdgeSprings {
  double deflection_N_per_m2 = 0;
  double normal_displacement_N_per_m2 = 0;
  double tangential_displacement_N_per_m2 = 0;
  double normal_rotation_N = 0;  ///< N m per rad and m
  double tangential_rotation_N = 0;
};

/// Four letters, edge i from corner i to i + 1: C clamped; F free; I u = v = w = 0; H as I with the tangential
/// rotation; S w, the normal displacement and the tangential rotation; T w, the tangential displacement and rotation; W
/// w only.
/// @throws std::invalid_argument naming the letter. Verified by: tests/impulse/ritz_plate.test.cpp
[[nodiscard]] std::array<HeldEdge, 4> parse_plate_edges(const std::string& letters);

/// A laminated plate, or a panel curved along y. z points in the direction of the force, into the plate.
struct Plate {
  enum class Theory {
    shear,  ///< first-order shear deformation: normals stay straight
    thin    ///< classical: and normal to the middle surface; no rotary inertia
  };

  /// Displacements in the plane: nothing along z moves them in a flat plate without coupling, whose modes in the plane
  /// are then left out of a body to be struck.
  enum class InPlane { when_coupled, always };

  PlateShape shape;
  Laminate laminate;
  std::array<HeldEdge, 4> edges{};
  std::array<EdgeSprings, 4> springs{};
  Theory theory = Theory::shear;
  InPlane in_plane = InPlane::when_coupled;
  double shear_correction = 5.0 / 6.0;  ///< factor of the transverse shear stiffness, > 0; `shear` only
  double curvature_per_m = 0;           ///< 1/R along y, positive if the convex side is struck
};

/// Mass of the plate: ρh times its area [kg].
[[nodiscard]] double mass_kg(const Plate& plate);

/// Whether the plate has displacements in its plane: always, or where a force along z moves it there too, by coupling B
/// or (`shear`) I₁ or by curvature.
[[nodiscard]] bool moves_in_plane(const Plate& plate);

/// @throws std::invalid_argument for a shape, a laminate, a shear correction or springs that are not valid, and for a
/// panel that its curvature would lead round once or more.
void require_valid(const Plate& plate);

}  // namespace impulse
