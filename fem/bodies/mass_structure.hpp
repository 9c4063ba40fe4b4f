#pragma once

#include "lib/material/profile.hpp"
#include "lib/model/structure.hpp"

#include <vector>

namespace impulse {

/// A rigid mass: one displacement, no stiffness, no wave admittance; c = 1 at its first face and -1 at the other, since
/// forces count into the body. @throws std::invalid_argument if the mass in kg is not positive, or for other than one
/// or two different faces. Verified by: tests/fem/explicit_contacts.test.cpp
[[nodiscard]] Structure mass_structure(double mass_kg, const std::vector<Face>& faces = {Face::a});

}  // namespace impulse
