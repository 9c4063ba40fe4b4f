#pragma once

#include "impulse/response/response.hpp"
#include "lib/material/profile.hpp"

#include <vector>

namespace impulse {

/// Response of a rigid mass m at its faces: G = ±1/m, H = ±t/m, U = ±t²/(2m), displacements and forces into the body:
/// + for a face with itself, - between the two.
/// @throws std::invalid_argument unless m > 0 and there are one or two different faces.
/// Verified by: tests/impulse/modal_response.test.cpp
[[nodiscard]] Response mass_response(double mass_kg, const std::vector<Face>& faces, const UniformGrid& grid);

/// At one face.
[[nodiscard]] Response mass_response(double mass_kg, const UniformGrid& grid);

}  // namespace impulse
