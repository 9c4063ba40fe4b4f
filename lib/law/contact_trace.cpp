#include "lib/law/contact_trace.hpp"

#include "lib/contract/require.hpp"

#include <algorithm>

namespace impulse {
namespace {

/// Time at which a linear indentation passes zero between samples k and k+1; sample `closed` if it doesn't (a rigid
/// contact).
double crossing_s(const std::vector<double>& indentation, const UniformGrid& grid, std::size_t k, std::size_t closed) {
  const double a = indentation[k];
  const double b = indentation[k + 1];
  if (a == b || a * b > 0) return grid.time_s(closed);
  return grid.time_s(k) + grid.step_s * a / (a - b);
}

}  // namespace

void bridge_wave_fronts(std::vector<bool>& in_contact) {
  std::size_t open = samples_that_end_a_rigid_contact;  // samples since the last one in contact
  for (std::size_t n = 0; n < in_contact.size(); ++n) {
    if (!in_contact[n]) {
      ++open;
      continue;
    }
    if (open < samples_that_end_a_rigid_contact)
      for (std::size_t k = n - open; k < n; ++k) in_contact[k] = true;
    open = 0;
  }
}

std::vector<ContactInterval> contact_intervals(const ContactTrace& trace, const UniformGrid& grid) {
  std::vector<ContactInterval> intervals;
  for (std::size_t k = 0; k < grid.size;) {
    if (!trace.in_contact[k]) {
      ++k;
      continue;
    }
    const std::size_t first = k;
    while (k < grid.size && trace.in_contact[k]) ++k;
    const std::size_t last = k - 1;
    ContactInterval interval;
    interval.start_s = first == 0 ? 0 : crossing_s(trace.indentation_m, grid, first - 1, first);
    interval.open_ended = k == grid.size;
    interval.end_s = interval.open_ended ? grid.duration_s() : crossing_s(trace.indentation_m, grid, last, last);
    const auto peak = std::max_element(trace.force_N.begin() + static_cast<std::ptrdiff_t>(first),
                                       trace.force_N.begin() + static_cast<std::ptrdiff_t>(k));
    interval.peak_force_N = *peak;
    interval.peak_time_s = grid.time_s(static_cast<std::size_t>(peak - trace.force_N.begin()));
    interval.impulse_Ns =
        trace.running_impulse_Ns[std::min(k, grid.size - 1)] - trace.running_impulse_Ns[first == 0 ? 0 : first - 1];
    intervals.push_back(interval);
  }
  return intervals;
}

BodyEnergy translational_energy(const FreeBody& body, const UniformGrid& grid, std::span<const ContactTrace> contacts) {
  require(body.mass_kg > 0, "mass {} kg is not positive", body.mass_kg);
  BodyEnergy energy{body.number, std::vector<double>(grid.size)};
  for (std::size_t k = 0; k < grid.size; ++k) {
    double momentum = body.mass_kg * body.speed_m_per_s;
    for (const ContactTrace& contact : contacts)
      momentum += body.direction * (contact.running_impulse_Ns[k] - body.preload_N * grid.time_s(k));
    energy.translational_J[k] = 0.5 * momentum * momentum / body.mass_kg;
  }
  return energy;
}

ContactsSummary contacts_summary(const std::vector<ContactTrace>& traces, const UniformGrid& grid,
                                 const ContactsScene& scene) {
  ContactsSummary summary;
  ImpactSummary& line = summary.impact;
  line.energy_error = scene.energy_error;
  std::optional<ContactInterval> first;
  for (std::size_t i = 0; i < traces.size(); ++i) {
    if (i < scene.contacts_of_body_1) line.impulse_Ns += traces[i].running_impulse_Ns.back();
    for (const ContactInterval& period : contact_intervals(traces[i], grid)) {
      ++summary.contact_count;
      if (!first || period.start_s < first->start_s) first = period;
      if (period.peak_force_N <= line.peak_force_N) continue;
      line.peak_force_N = period.peak_force_N;
      line.peak_time_s = period.peak_time_s;
    }
  }
  if (first) line.contact_duration_s = first->end_s - first->start_s;
  if (!scene.mass_1_kg) return summary;
  line.rebound_speed_m_per_s = scene.speed_1_m_per_s - line.impulse_Ns / *scene.mass_1_kg;
  const double closing = scene.speed_1_m_per_s - scene.speed_2_m_per_s;
  if (scene.mass_2_kg && closing != 0)
    summary.restitution = line.impulse_Ns * (1 / *scene.mass_1_kg + 1 / *scene.mass_2_kg) / closing - 1;
  return summary;
}

}  // namespace impulse
