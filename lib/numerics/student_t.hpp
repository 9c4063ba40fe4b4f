#pragma once

namespace impulse {

/// t with P(T ≤ t) = p for Student's distribution with ν degrees of freedom (GSL); the half-width of a two-sided 95 %
/// band is student_t_quantile(0.975, ν) standard uncertainties.
/// @throws std::invalid_argument unless 0 < p < 1 and ν > 0. Verified by: tests/lib/special_functions.test.cpp
[[nodiscard]] double student_t_quantile(double p, double degrees_of_freedom);

}  // namespace impulse
