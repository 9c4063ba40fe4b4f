#include "lib/law/indentation_time.hpp"

#include "lib/contract/require.hpp"
#include "lib/numerics/roots.hpp"

#include <cmath>

namespace impulse {

double indentation_time_s(const ContactLaw& law, double mass_kg, double speed_m_per_s) {
  require(!law.is_rigid(), "a rigid law has no indentation");
  require(mass_kg > 0 && std::isfinite(mass_kg), "the striker's mass {} kg is not positive", mass_kg);
  require(speed_m_per_s > 0 && std::isfinite(speed_m_per_s), "the striker's speed {} m/s is not positive",
          speed_m_per_s);
  const double energy = mass_kg * speed_m_per_s * speed_m_per_s / 2;
  const auto lacking = [&](double indentation) {
    const LawHistory history = law.advanced({}, indentation);
    return law.stored_energy(indentation, history) + history.dissipated_J - energy;
  };
  const double most = law.largest_possible_indentation_m();
  double high = std::fmin(1e-9, most);
  while (high < most && lacking(high) < 0) high = std::fmin(2 * high, most);
  if (lacking(high) < 0) return most / speed_m_per_s;
  return bracketed_root(lacking, 0, high, {.relative = 1e-12}) / speed_m_per_s;
}

}  // namespace impulse
