#pragma once

#include <array>

namespace impulse {

/// The four cubic Hermite functions on 0 ≤ t ≤ 1 and their derivatives by t, in the order
///
///   value at 0, slope at 0, value at 1, slope at 1.
struct CubicHermite {
  std::array<double, 4> value;
  std::array<double, 4> first;
  std::array<double, 4> second;
};

[[nodiscard]] constexpr CubicHermite cubic_hermite(double t) {
  return {{1 + t * t * (2 * t - 3), t * (1 + t * (t - 2)), t * t * (3 - 2 * t), t * t * (t - 1)},
          {6 * t * (t - 1), 1 + t * (3 * t - 4), 6 * t * (1 - t), t * (3 * t - 2)},
          {12 * t - 6, 6 * t - 4, 6 - 12 * t, 6 * t - 2}};
}

/// Gauss-Legendre rule of four points on [0, 1], exact to degree 7: what the consistent mass of a flat element needs.
inline constexpr std::array<double, 4> gauss_point{0.069431844202973712, 0.33000947820757187, 0.66999052179242813,
                                                   0.93056815579702629};
inline constexpr std::array<double, 4> gauss_weight{0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                                    0.17392742256872693};

}  // namespace impulse
