#include "lib/law/impact_history.hpp"

#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {

std::size_t contact_end_index(const std::vector<double>& force_N) {
  // Equal rods are left touching without a force; what rounding makes of it, some 10⁻¹³ of the largest, is none.
  constexpr double rounding = 1e-11;
  std::size_t run = 0;
  double largest = 0;
  for (std::size_t k = 0; k < force_N.size(); ++k) {
    largest = std::max(largest, force_N[k]);
    run = force_N[k] <= rounding * largest ? run + 1 : 0;
    if (run == 3) return k - 2;
  }
  return force_N.size();
}

double contact_end_s(const std::vector<double>& force_N, const UniformGrid& grid, std::size_t end) {
  require(force_N.size() == grid.size, "{} force samples on a grid of {}", force_N.size(), grid.size);
  require(end <= grid.size, "contact ends at sample {} of a record of {}", end, grid.size);
  if (end == 0) return 0;
  if (end == grid.size) return grid.duration_s();
  const double before = force_N[end - 1];
  const double after = std::min(force_N[end], 0.0);
  if (before <= 0) return grid.time_s(end - 1);
  return grid.time_s(end - 1) + grid.step_s * before / (before - after);
}

double impulse_Ns(const ImpactHistory& history) {
  if (history.acted_impulse_Ns) return *history.acted_impulse_Ns;
  const std::vector<double>& force = history.force_N;
  const UniformGrid& grid = history.grid;
  require(force.size() == grid.size, "{} force samples on a grid of {}", force.size(), grid.size);
  double impulse = 0;
  for (std::size_t k = 0; k + 1 < force.size(); ++k) {
    const double since = history.contact_end_s - grid.time_s(k);
    const bool released_here = history.separated && force[k + 1] <= 0 && since >= 0 && since < grid.step_s;
    impulse += released_here ? 0.5 * force[k] * since : 0.5 * grid.step_s * (force[k] + force[k + 1]);
  }
  return impulse;
}

ImpactSummary summary(const ImpactHistory& history, double speed_m_per_s, std::optional<double> mass_1_kg) {
  require(!history.force_N.empty(), "an impact history without samples has no summary");
  ImpactSummary line;
  line.peak_force_N = *std::max_element(history.force_N.begin(), history.force_N.end());
  // On a plateau the largest sample is rounding's choice; the plateau's first sample is not.
  const auto reached = std::find_if(history.force_N.begin(), history.force_N.end(),
                                    [&](double f) { return f >= (1 - 1e-9) * line.peak_force_N; });
  line.peak_time_s = history.grid.time_s(static_cast<std::size_t>(reached - history.force_N.begin()));
  line.contact_duration_s = history.contact_end_s;
  line.impulse_Ns = impulse_Ns(history);
  if (mass_1_kg) {
    require(std::isfinite(*mass_1_kg) && *mass_1_kg > 0, "mass {} kg of body 1 is not positive", *mass_1_kg);
    line.rebound_speed_m_per_s = speed_m_per_s - line.impulse_Ns / *mass_1_kg;
  }
  line.energy_error = history.energy_error;
  return line;
}

}  // namespace impulse
