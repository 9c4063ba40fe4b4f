#include "fem/explicit/explicit_contact.hpp"

#include "fem/explicit/explicit_contacts.hpp"
#include "lib/contract/require.hpp"

#include <cmath>
#include <utility>

namespace impulse {

ExplicitContactResult explicit_contact(const Structure& projectile, const Structure& target,
                                       const ExplicitContact& contact) {
  const double first = contact.speed_m_per_s, second = contact.speed_2_m_per_s;
  require(std::isfinite(first) && (second != 0 || first > 0), "speed {} m/s is not positive", first);
  require(std::isfinite(second) && first > second,
          "the projectile's {} m/s do not exceed the target's {} m/s, so they never meet", first, second);
  for (const Structure* body : {&projectile, &target})
    require(body->contacts.cols() == 1, "the {} has {} contacts; explicit_contact takes one, explicit_contacts more",
            body == &projectile ? "projectile" : "target", body->contacts.cols());
  ExplicitContactsResult result = explicit_contacts(
      {{projectile, first, contact.projectile_subcycles}, {target, second, 1}}, {.step_s = contact.step_s,
                                                                                 .duration_s = contact.duration_s,
                                                                                 .laws = {contact.law},
                                                                                 .gaps_m = {contact.gap_m},
                                                                                 .after_contact = contact.after_contact,
                                                                                 .matching = contact.matching,
                                                                                 .start = contact.start});
  return {result.grid,         std::move(result.traces[0]), result.balances[0],
          result.balances[1],  result.in_contact_at_end,    result.contact_end_s,
          result.energy_error, result.trial_count};
}

}  // namespace impulse
