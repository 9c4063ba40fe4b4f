#pragma once

#include "lib/model/structure.hpp"

namespace impulse {

/// A rigid mass: one displacement, no stiffness, a contact with c = 1 and no wave admittance.
/// @throws std::invalid_argument if the mass in kg is not positive. Verified by: tests/fem/explicit_contact.test.cpp
[[nodiscard]] Structure mass_structure(double mass_kg);

}  // namespace impulse
