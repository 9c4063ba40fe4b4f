#pragma once

namespace impulse {

/// t with P(T ≤ t) = p for Student's distribution with ν degrees of freedom (GSL); the half-width of a two-sided 95 %
/// band is student_t_quantile(0.975, ν) standard uncertainties.
/// @throws std::invalid_argument unless 0 < p < 1 and ν > 0. Verified by: tests/lib/special_functions.test.cpp
[[nodiscard]] double student_t_quantile(double p, double degrees_of_freedom);

/// k such that, with probability `confidence`, at most a share `outside` of the values of one curve lie further than k
/// of their own standard uncertainties from the truth, however their errors depend on each other:
///
///   k = t(1 - outside (1 - confidence)/2, ν).
///
/// A value lies beyond k with probability p = outside·(1 - confidence), which is the share's mean; by Markov's
/// inequality the share exceeds `outside` with at most p/outside. Of N values, outside = 1/N is Bonferroni's band, of
/// which none lies beyond. For 5 % it is nearly the least that holds for every dependence: of 19 groups of values with
/// one error each, independent of the others', one group beyond is too many, and 19 p of curves have one.
/// @throws std::invalid_argument unless 0 < outside < 1, 0 < confidence < 1 and ν > 0.
/// Verified by: tests/lib/special_functions.test.cpp, tests/impulse/response_coverage.test.cpp
[[nodiscard]] double curve_band_factor(double confidence, double outside, double degrees_of_freedom);

}  // namespace impulse
