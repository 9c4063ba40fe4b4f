#pragma once

#include <cstddef>

namespace impulse {

/// Refuses a contact law that the step does not resolve. With κ = law's stiffness · approach that a unit force takes
/// back from the bodies within the step, the mean force that conserves energy multiplies a deviation by
/// (1 - κ/2)/(1 + κ/2) each step, negative beyond κ = 2.
/// @throws std::invalid_argument if κ > 2, naming the contact (counted from 1) and a step that resolves it.
/// Verified by: tests/lib/resolved_law.test.cpp
void require_resolved_law(double stiffness_ratio, std::size_t contact, double step_s);

}  // namespace impulse
