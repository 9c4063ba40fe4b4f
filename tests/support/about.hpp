#pragma once

#include <doctest/doctest.h>

namespace impulse {

/// x to a relative epsilon: about(x).epsilon(e) takes what differs by e·|x| at most, 1.2·10⁻⁵ where no epsilon is
/// given. doctest's own Approx takes e·(1 + |x|), which for a deflection in metres is anything. Zero is zero.
inline doctest::Approx about(double x) { return doctest::Approx(x).scale(1e-200); }

}  // namespace impulse
