#include "fem/explicit/law_contact.hpp"

#include "lib/contract/require.hpp"
#include "lib/numerics/roots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace impulse {

LawContact::LawContact(StrikingBody& projectile, StrikingBody& target, const ContactLaw& law, double indentation_m)
    : projectile_(projectile),
      target_(target),
      law_(law),
      held_1_(projectile, 1),
      held_2_(target, 1),
      compliance_(held_1_.face_displacement() + held_2_.face_displacement()),
      indentation_m_(indentation_m) {
  require(!law.is_rigid(), "a rigid contact has no law of indentation");
}

double LawContact::step(double flight_m) {
  projectile_.drop_force(mean_force_);
  target_.drop_force(mean_force_);
  projectile_.integrate(0, 0);
  target_.integrate(0, 0);
  const double free = flight_m - projectile_.face_displacement() - target_.face_displacement();
  const double opens_at = law_.permanent_indentation(history_);
  if (open_for_good_ || (free <= opens_at && indentation_m_ <= opens_at)) {
    mean_force_ = 0;
    indentation_m_ = free;
    return 0;
  }
  const double end = end_indentation(free);
  mean_force_ = mean_force(end);
  held_1_.add_to(projectile_, mean_force_);
  held_2_.add_to(target_, mean_force_);
  history_ = law_.advanced(history_, end);
  indentation_m_ = end;
  return mean_force_;
}

double LawContact::mean_force(double end) const {
  const double begin = indentation_m_;
  // Where the difference of energies would be mostly rounding, Simpson's rule is exact enough.
  if (std::abs(end - begin) <= 1e-4 * std::max(std::abs(begin), std::abs(end))) {
    const double middle = law_.force(0.5 * (begin + end), history_);
    return (law_.force(begin, history_) + 4 * middle + law_.force(end, history_)) / 6;
  }
  const LawHistory after = law_.advanced(history_, end);
  const double stored = law_.stored_energy(end, after) - law_.stored_energy(begin, history_);
  return (stored + after.dissipated_J - history_.dissipated_J) / (end - begin);
}

double LawContact::end_indentation(double free) const {
  const auto excess = [&](double end) { return end - free + compliance_ * mean_force(end); };
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

bool LawContact::in_contact() const { return !open_for_good_ && depth_m() > 0; }

double LawContact::force_N() const { return open_for_good_ ? 0 : law_.force(indentation_m_, history_); }

double LawContact::stored_J() const { return open_for_good_ ? 0 : law_.stored_energy(indentation_m_, history_); }

}  // namespace impulse
