#pragma once

#include "fem/shell/mid_surface.hpp"
#include "lib/material/laminate.hpp"

#include <array>
#include <string>
#include <vector>

namespace impulse {

/// What holds an edge. ν is the direction in the surface across the edge, τ along it, n the normal; the displacements
/// refer to the ideal shape, the rotation to the imperfect one.
enum class EdgeSupport {
  free,
  clamped,          ///< u = 0 and n·u_,ν = 0
  immovable,        ///< u = 0
  held_across,      ///< n·u = ν·u = 0
  held_along,       ///< n·u = τ·u = 0; a diaphragm
  held_deflection,  ///< n·u = 0
  symmetric,        ///< ν·u = 0 and n·u_,ν = 0: the panel goes on as its mirror image
};

/// Reads four letters, one for each edge in the order y = 0, x = a, y = b, x = 0: C clamped, F free, I immovable, S
/// held across, T held along, W deflection held, Y symmetric. H (I and no rotation along the edge) is I here, because a
/// thin shell's edge that doesn't deflect can't turn in its own direction.
/// @throws std::invalid_argument naming the letter. Verified by: tests/fem/shell_supports.test.cpp
[[nodiscard]] std::array<EdgeSupport, 4> parse_edges(const std::string& letters);

/// A thin laminated panel and its mesh of bicubic Hermite elements. Fibre angles count from x towards y about n = z in
/// the middle; the first layer is on the struck side.
struct ShellPanel {
  PanelShape shape;
  Laminate laminate;
  std::array<EdgeSupport, 4> edges{};
  std::vector<double> lines_x;  ///< element boundaries from 0 to the length [m]
  std::vector<double> lines_y;  ///< from 0 to the width [m]
};

/// @throws std::invalid_argument if the shape is not valid, the lines don't rise from 0 to the side's length, or the
/// laminate has no thickness or mass or is no thin shell's: thicker than a side or the radius of curvature.
void require_valid(const ShellPanel& panel);

}  // namespace impulse
