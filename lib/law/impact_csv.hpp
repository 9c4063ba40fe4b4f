#pragma once

#include "lib/law/impact_history.hpp"

#include <string>

namespace impulse {

/// Columns `time_s, force_N, velocity_1_m_per_s, velocity_2_m_per_s`. @throws OutputError.
void write_history(const std::string& path, const ImpactHistory& history);

/// One row `peak_force_N, peak_time_s, contact_duration_s, impulse_Ns, rebound_speed_m_per_s, energy_error`; the rebound speed is
/// empty if the mass is not known. @throws OutputError. Verified by: tests/tools/ir-impact/
void write_summary(const std::string& path, const ImpactSummary& line);

}  // namespace impulse
