#include "fem/shell/shell_panel.hpp"

#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {
namespace {

EdgeSupport edge_support(char letter) {
  switch (letter) {
    case 'C':
      return EdgeSupport::clamped;
    case 'F':
      return EdgeSupport::free;
    case 'I':
    case 'H':
      return EdgeSupport::immovable;
    case 'S':
      return EdgeSupport::held_across;
    case 'T':
      return EdgeSupport::held_along;
    case 'W':
      return EdgeSupport::held_deflection;
    case 'Y':
      return EdgeSupport::symmetric;
    default:
      break;
  }
  require(false, "'{}' is not a support; use C, F, H, I, S, T, W or Y", letter);
  return EdgeSupport::free;
}

void require_lines(const std::vector<double>& lines, double length, char side) {
  require(lines.size() >= 2, "the mesh has no elements along {}", side);
  require(lines.front() == 0 && std::abs(lines.back() - length) <= 1e-12 * length,
          "the mesh lines along {} go from {} m to {} m and not from 0 to {} m", side, lines.front(), lines.back(),
          length);
  for (std::size_t i = 1; i < lines.size(); ++i)
    require(lines[i] > lines[i - 1], "mesh line {} along {} at {} m isn't beyond the one before", i + 1, side,
            lines[i]);
}

}  // namespace

std::array<EdgeSupport, 4> parse_edges(const std::string& letters) {
  require(letters.size() == 4, "'{}' has {} letters for four edges (y = 0, x = a, y = b, x = 0)", letters,
          letters.size());
  std::array<EdgeSupport, 4> edges{};
  for (std::size_t i = 0; i < 4; ++i) edges[i] = edge_support(letters[i]);
  return edges;
}

void require_valid(const ShellPanel& panel) {
  require_valid(panel.shape);
  require_lines(panel.lines_x, panel.shape.length_m, 'x');
  require_lines(panel.lines_y, panel.shape.width_m, 'y');
  require(panel.laminate.thickness_m > 0, "the laminate's thickness {} m is not positive", panel.laminate.thickness_m);
  const double shorter = std::fmin(panel.shape.length_m, panel.shape.width_m);
  require(panel.laminate.thickness_m < shorter,
          "the laminate is {:.4g} m thick, the panel only {:.4g} m wide; a thin shell is wider than thick",
          panel.laminate.thickness_m, shorter);
  require(panel.shape.curvature == Curvature::flat || panel.laminate.thickness_m < std::abs(panel.shape.radius_m),
          "the laminate is {:.4g} m thick and the radius of curvature {:.4g} m; a thin shell has the larger radius",
          panel.laminate.thickness_m, std::abs(panel.shape.radius_m));
  require(panel.laminate.mass_kg_per_m2 > 0, "the laminate's mass {} kg/m² is not positive",
          panel.laminate.mass_kg_per_m2);
}

}  // namespace impulse
