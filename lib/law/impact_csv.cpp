#include "lib/law/impact_csv.hpp"

#include "lib/csv/csv_output.hpp"

namespace impulse {

void write_history(const std::string& path, const ImpactHistory& history) {
  std::vector<double> time(history.grid.size);
  for (std::size_t k = 0; k < time.size(); ++k) time[k] = history.grid.time_s(k);
  write_csv(path, {{"time_s", time},
                   {"force_N", history.force_N},
                   {"velocity_1_m_per_s", history.velocity_1_m_per_s},
                   {"velocity_2_m_per_s", history.velocity_2_m_per_s}});
}

void write_summary(const std::string& path, const ImpactSummary& line) {
  CsvOutput out(path, {"peak_force_N", "peak_time_s", "contact_duration_s", "impulse_Ns", "rebound_speed_m_per_s", "energy_error"});
  const CsvField rebound = line.rebound_speed_m_per_s ? CsvField(*line.rebound_speed_m_per_s) : CsvField();
  out.row({line.peak_force_N, line.peak_time_s, line.contact_duration_s, line.impulse_Ns, rebound, line.energy_error});
  out.close();
}

}  // namespace impulse
