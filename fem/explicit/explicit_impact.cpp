#include "fem/explicit/explicit_impact.hpp"

#include "fem/explicit/explicit_contact.hpp"
#include "lib/contract/require.hpp"

#include <utility>

namespace impulse {

ExplicitImpactResult explicit_impact(const Structure& projectile, const Structure& target,
                                     const ExplicitImpact& impact) {
  require(impact.after_contact != AfterContact::touch_again,
          "an impact has one contact; explicit_contact lets bodies touch again");
  ExplicitContactResult result = explicit_contact(projectile, target,
                                                  {.speed_m_per_s = impact.speed_m_per_s,
                                                   .step_s = impact.step_s,
                                                   .projectile_subcycles = impact.projectile_subcycles,
                                                   .duration_s = impact.duration_s,
                                                   .after_contact = impact.after_contact,
                                                   .matching = impact.matching,
                                                   .start = impact.start});
  ImpactHistory history{.grid = result.grid,
                        .force_N = std::move(result.trace.force_N),
                        .velocity_1_m_per_s = std::move(result.trace.velocity_1_m_per_s),
                        .velocity_2_m_per_s = std::move(result.trace.velocity_2_m_per_s),
                        .acted_impulse_Ns = result.trace.running_impulse_Ns.back(),
                        .separated = !result.in_contact_at_end,
                        .contact_end_s = result.contact_end_s,
                        .energy_error = result.energy_error};
  return {std::move(history), result.projectile, result.target, result.trial_count};
}

}  // namespace impulse
