#pragma once

namespace impulse {

/// J0(√s) and J1(√s)/√s as functions of s, which may be negative; there I0(√-s) e^(-√-s) and I1(√-s)/√-s e^(-√-s), so
/// that nothing overflows. Both are smooth through s = 0 but for that factor. (GSL; error a few ε, absolute.)
/// @throws std::invalid_argument if s is not finite. Verified by: tests/lib/special_functions.test.cpp
struct BesselPair {
  double zeroth = 1;
  double first = 0.5;
};
[[nodiscard]] BesselPair scaled_bessel_pair(double s);

}  // namespace impulse
