#pragma once

#include "impulse/response/response.hpp"

namespace impulse {

/// Response of a rigid mass m: G = 1/m, H = t/m, U = t²/(2m).
/// @throws std::invalid_argument unless m > 0. Verified by: tests/impulse/mass_response.test.cpp
[[nodiscard]] Response mass_response(double mass_kg, const UniformGrid& grid);

}  // namespace impulse
