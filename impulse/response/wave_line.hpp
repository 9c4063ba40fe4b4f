#pragma once

#include "lib/material/profile.hpp"

#include <vector>

namespace impulse {

/// One segment as a wave sees it, from the struck end towards the far end.
///
/// In a cone ψ = D·u obeys the plain wave equation, so velocity waves keep their shape and scale with 1/D:
/// r(y,t) ∝ f(t - y/c)/D to the right, l ∝ g(t + y/c)/D to the left, velocity v = r + l. Force (tension) in the Laplace
/// domain:
///
///   N = -Z [(1 + κ/s) r - (1 - κ/s) l],   Z = A√(Eρ),   κ = c D'/D   (κ = 0 in a cylinder)
struct WavePiece {
  double travel_time_s;
  double impedance_left;  ///< Z [kg/s]
  double impedance_right;
  double taper_left;  ///< κ [1/s]
  double taper_right;
  double spread;  ///< D_left/D_right: what a wave to the right is multiplied by on its way
};

struct WaveLine {
  std::vector<WavePiece> pieces;
  FarEnd far_end = FarEnd::free;
};

/// The chain from its end A (give reversed(profile) for end B).
[[nodiscard]] WaveLine wave_line(const Profile& profile, FarEnd far_end);

/// Scattering at the ends and joints of a line. T is what 1/s is: a complex number, or a power series.
///
/// At a joint of a (left) and b (right), continuity of v and N with r_a and l_b coming in gives, d = Z_b(1 + κ_b/s) +
/// Z_a(1 - κ_a/s),
///   l_a = [Z_a(1 + κ_a/s) - Z_b(1 + κ_b/s)]/d · r_a + 2Z_b/d · l_b,      r_b = 2Z_a/d · r_a + (2Z_b/d - 1) · l_b.
template <class T>
struct Joint {
  T reflection_left;     ///< r_a → l_a
  T transmission_right;  ///< r_a → r_b
  T transmission_left;   ///< l_b → l_a
  T reflection_right;    ///< l_b → r_b
};

template <class T>
Joint<T> joint(double za, double kappa_a, double zb, double kappa_b, const T& inverse_s) {
  const T one = T(1.0);
  const T forward_a = za * (one + kappa_a * inverse_s);
  const T forward_b = zb * (one + kappa_b * inverse_s);
  const T denominator = forward_b + za * (one - kappa_a * inverse_s);
  const T from_right = T(2 * zb) / denominator;
  return {(forward_a - forward_b) / denominator, T(2 * za) / denominator, from_right, from_right - one};
}

/// r = source·F + reflection·l at the struck end, F the compressive force there.
template <class T>
struct StruckEnd {
  T source;
  T reflection;
};

template <class T>
StruckEnd<T> struck_end(const WavePiece& first, const T& inverse_s) {
  const T forward = T(1.0) + first.taper_left * inverse_s;
  return {T(1.0) / (first.impedance_left * forward), (T(1.0) - first.taper_left * inverse_s) / forward};
}

/// l = far_reflection·r at the far end.
template <class T>
T far_reflection(const WavePiece& last, FarEnd far_end, const T& inverse_s) {
  switch (far_end) {
    case FarEnd::free:
      return (T(1.0) + last.taper_right * inverse_s) / (T(1.0) - last.taper_right * inverse_s);
    case FarEnd::fixed:
      return T(-1.0);
    case FarEnd::infinite:
      // A cylinder of the end section goes on: a joint from which nothing comes back.
      return joint(last.impedance_right, last.taper_right, last.impedance_right, 0.0, inverse_s).reflection_left;
  }
  return T(0.0);
}

}  // namespace impulse
