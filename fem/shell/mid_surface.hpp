#pragma once

#include <Eigen/Dense>

#include <vector>

namespace impulse {

/// What a node of bicubic Hermite interpolation holds of a vector field f(x, y): columns f, f_x, f_y, f_xy.
using HermiteNode = Eigen::Matrix<double, 3, 4>;

enum class Curvature {
  flat,
  along_x,  ///< a cylinder whose axis is along y
  along_y,  ///< a cylinder whose axis is along x
  both,     ///< a sphere
};

/// Stress-free departure of the mid-surface from its ideal shape, along z:
///
///   v_z = Σ A sin(mπx/a) sin(nπy/b) + Σ A sin²(mπx/a) sin²(nπy/b) + Σ C (x/a)^p (y/b)^q
///
/// The squares are level at the edges, as what a clamped panel is pressed into.
struct Imperfection {
  struct Wave {
    double amplitude_m = 0;
    int m = 1;  ///< half waves along x, ≥ 1
    int n = 1;  ///< half waves along y, ≥ 1
  };
  struct Power {
    double coefficient_m = 0;
    int p = 0;  ///< ≥ 0
    int q = 0;  ///< ≥ 0
  };
  std::vector<Wave> waves;
  std::vector<Wave> squared_waves;
  std::vector<Power> powers;
};

/// Mid-surface of a panel over 0 ≤ x ≤ a, 0 ≤ y ≤ b, where x and y are lengths of arc (on a sphere x along every
/// meridian, y along the parallel x = a/2). With ξ = x - a/2, η = y - b/2 and the radius R:
///
///   flat      (ξ, η, 0)
///   along_y   (ξ, R sin η/R, R - R cos η/R)
///   along_x   (R sin ξ/R, η, R - R cos ξ/R)
///   both      (R sin ξ/R, R cos ξ/R sin η/R, R - R cos ξ/R cos η/R)
///
/// so the middle of the panel is the origin, and z is the normal there and the direction in which a striking body
/// arrives. R > 0: it arrives on the convex side; R < 0: on the concave one.
struct PanelShape {
  double length_m = 0;  ///< a
  double width_m = 0;   ///< b
  Curvature curvature = Curvature::flat;
  double radius_m = 0;  ///< R; 0 for a flat panel
  Imperfection imperfection{};
};

/// @throws std::invalid_argument if a length is not positive, a radius is given to a flat panel or none to a curved
/// one, or the arc is longer than the circle (on a sphere: x beyond the poles).
void require_valid(const PanelShape& shape);

/// r, r_x, r_y, r_xy of the imperfect mid-surface at (x, y). Verified by: tests/fem/mid_surface.test.cpp
[[nodiscard]] HermiteNode mid_surface(const PanelShape& shape, double x, double y);

/// Element boundaries from 0 to `length`: `count` elements whose sizes grow geometrically away from `towards`, the
/// longest on the longer side `grading` times the shortest. With a grading above 1 `towards` is a boundary, unless it
/// is an end, from which the sizes then grow.
/// @throws std::invalid_argument if count is 0, or 1 with a grading inside, grading < 1, or `towards` is outside.
/// Verified by: tests/fem/mid_surface.test.cpp
[[nodiscard]] std::vector<double> graded_lines(double length, std::size_t count, double towards, double grading);

}  // namespace impulse
