#pragma once

#include "lib/law/contact_trace.hpp"
#include "lib/law/impact_history.hpp"

#include <string>

namespace impulse {

/// Columns `time_s, force_N, velocity_1_m_per_s, velocity_2_m_per_s`. @throws OutputError.
void write_history(const std::string& path, const ImpactHistory& history);

/// One row `peak_force_N, peak_time_s, contact_duration_s, impulse_Ns, rebound_speed_m_per_s, energy_error`; the
/// rebound speed is empty if the mass is not known. @throws OutputError. Verified by: tests/tools/ir-impact/
void write_summary(const std::string& path, const ImpactSummary& line);

/// A contact's history: time_s, force_N, velocity_1_m_per_s, velocity_2_m_per_s, indentation_m, running_impulse_Ns,
/// in_contact (0 or 1), displacement_1_m, displacement_2_m, stored_J, dissipated_J, work_1_J, work_2_J,
/// energy_balance_J (the sum of the four before it, less what a preload had stored at t = 0: 0 but for what a rigid
/// contact loses in closing and, of order 2 in the step, for a residual flexibility of the bodies). Several contacts
/// have one set each, numbered before the unit: force_1_N, in_contact_1; velocity_12_m_per_s is that of side 2 of
/// contact 1. Then translational_energy_1_J of each of `bodies`.
/// @throws OutputError.
void write_traces(const std::string& path, const UniformGrid& grid, const std::vector<ContactTrace>& traces,
                  const std::vector<BodyEnergy>& bodies = {});

/// A row `contact,start_s,end_s,peak_force_N,peak_time_s,impulse_Ns` for every period of contact, by contact and time.
/// @throws OutputError.
void write_intervals(const std::string& path, const UniformGrid& grid, const std::vector<ContactTrace>& traces);

/// The row of write_summary with two more columns: contact_count (periods of contact) and restitution (empty if a mass
/// is not known).
void write_summary(const std::string& path, const ContactsSummary& summary);

}  // namespace impulse
