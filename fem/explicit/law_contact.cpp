#include "fem/explicit/law_contact.hpp"

#include "lib/contract/require.hpp"
#include "lib/numerics/roots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace impulse {

LawContact::LawContact(const ContactLaw& law, double residual_flexibility_m_per_N, double indentation_m)
    : law_(law), residual_(residual_flexibility_m_per_N), indentation_m_(indentation_m) {
  require(!law.is_rigid(), "a rigid contact has no law of indentation");
}

LawContact::Answer LawContact::answer(double free_approach_m, double compliance_m_per_N) const {
  const double opens_at = law_.permanent_indentation(history_);
  if (open_for_good_ || (free_approach_m <= opens_at && indentation_m_ <= opens_at)) return {free_approach_m, 0, 0};
  const double end = end_indentation(free_approach_m, compliance_m_per_N);
  return {end, mean_force(end), law_.force(end, history_)};
}

void LawContact::accept(const Answer& answer) {
  const double opens_at = law_.permanent_indentation(history_);
  const bool stayed_open = answer.indentation_m <= opens_at && indentation_m_ <= opens_at;
  if (!open_for_good_ && !stayed_open) history_ = law_.advanced(history_, answer.indentation_m);
  indentation_m_ = answer.indentation_m;
  mean_force_ = answer.mean_force_N;
}

double LawContact::approach(double indentation) const {
  return residual_ == 0 ? indentation : indentation + residual_ * law_.force(indentation, history_);
}

double LawContact::mean_force(double end) const {
  const double begin = indentation_m_;
  // Where the difference of energies would be mostly rounding, Simpson's rule is exact enough.
  if (std::abs(end - begin) <= 1e-4 * std::max(std::abs(begin), std::abs(end))) {
    const double middle = law_.force(0.5 * (begin + end), history_);
    return (law_.force(begin, history_) + 4 * middle + law_.force(end, history_)) / 6;
  }
  const LawHistory after = law_.advanced(history_, end);
  const double force_begin = law_.force(begin, history_), force_end = law_.force(end, history_);
  const double taken_up = law_.stored_energy(end, after) - law_.stored_energy(begin, history_) + after.dissipated_J -
                          history_.dissipated_J +
                          0.5 * residual_ * (force_end - force_begin) * (force_end + force_begin);
  return taken_up / (end - begin + residual_ * (force_end - force_begin));
}

double LawContact::end_indentation(double free, double compliance) const {
  const auto excess = [&](double end) { return approach(end) - free + compliance * mean_force(end); };
  const double last = law_.largest_possible_indentation_m();
  const double high = std::min(free, last);
  const double over = excess(high);
  require(high == free || over >= 0,
          "the contact is pressed to more than {:.4g} m, the last point of its law's table; extend the table", last);
  const double scale = std::max(std::abs(high), std::abs(indentation_m_));
  // A force too small to move the faces by a rounding error.
  if (over <= std::numeric_limits<double>::epsilon() * scale) return high;
  // The force is no larger below, so that the excess falls at least as fast as the indentation; but for rounding.
  double width = over;
  while (excess(high - width) > 0) width *= 2;
  return bracketed_root(excess, high - width, high, {.absolute = 1e-17 * scale, .relative = 1e-15});
}

double LawContact::stiffness_ratio(double compliance) const {
  if (!in_contact() || indentation_m_ < history_.largest_indentation_m) return 0;
  const double tangent = law_.tangent(indentation_m_, history_);
  return compliance * tangent / (1 + residual_ * tangent);
}

double LawContact::force_N() const { return open_for_good_ ? 0 : law_.force(indentation_m_, history_); }

double LawContact::stored_J() const { return open_for_good_ ? 0 : law_.stored_energy(indentation_m_, history_); }

}  // namespace impulse
