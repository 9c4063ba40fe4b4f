#pragma once

#include "lib/law/contact_law.hpp"

namespace impulse {

/// αm/V [s] with the indentation αm at which a rigid wall stops a striker of mass m at speed V, ∫₀^αm F dα = ½ m V²:
/// the shortest time in which the law's force can rise. A table that ends before has its last indentation for αm. For F
/// = k α: √(m/k), of a contact of π √(m/k); for F = k α^1.5: (5 m V²/4k)^0.4/V, of 2.94 times as much.
/// @throws std::invalid_argument for a rigid law, or a mass or speed that is not positive.
/// Verified by: tests/lib/indentation_time.test.cpp
[[nodiscard]] double indentation_time_s(const ContactLaw& law, double mass_kg, double speed_m_per_s);

}  // namespace impulse
