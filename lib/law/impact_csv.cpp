#include "lib/law/impact_csv.hpp"

#include "lib/csv/csv_output.hpp"

namespace impulse {
namespace {

std::vector<double> energy_balance(const ContactTrace& trace) {
  std::vector<double> sum(trace.work_1_J.size());
  for (std::size_t k = 0; k < sum.size(); ++k)
    sum[k] = trace.work_1_J[k] + trace.work_2_J[k] + (trace.stored_J[k] - trace.stored_J[0]) + trace.dissipated_J[k];
  return sum;
}

}  // namespace

void write_history(const std::string& path, const ImpactHistory& history) {
  std::vector<double> time(history.grid.size);
  for (std::size_t k = 0; k < time.size(); ++k) time[k] = history.grid.time_s(k);
  write_csv(path, {{"time_s", time},
                   {"force_N", history.force_N},
                   {"velocity_1_m_per_s", history.velocity_1_m_per_s},
                   {"velocity_2_m_per_s", history.velocity_2_m_per_s}});
}

void write_traces(const std::string& path, const UniformGrid& grid, const std::vector<ContactTrace>& traces,
                  const std::vector<BodyEnergy>& bodies) {
  std::vector<double> time(grid.size);
  for (std::size_t k = 0; k < time.size(); ++k) time[k] = grid.time_s(k);
  std::vector<NamedColumn> columns{{"time_s", time}};
  std::vector<std::vector<double>> closed, balance;
  closed.reserve(traces.size());
  balance.reserve(traces.size());
  for (std::size_t i = 0; i < traces.size(); ++i) {
    const ContactTrace& trace = traces[i];
    const std::string contact = traces.size() == 1 ? "" : fmt::format("{}", i + 1);
    const std::string number = contact.empty() ? "" : "_" + contact;
    closed.emplace_back(trace.in_contact.begin(), trace.in_contact.end());
    balance.push_back(energy_balance(trace));
    const auto add = [&](const std::string& name, const std::vector<double>& values) {
      columns.push_back({name, values});
    };
    add(fmt::format("force{}_N", number), trace.force_N);
    add(fmt::format("velocity_{}1_m_per_s", contact), trace.velocity_1_m_per_s);
    add(fmt::format("velocity_{}2_m_per_s", contact), trace.velocity_2_m_per_s);
    add(fmt::format("indentation{}_m", number), trace.indentation_m);
    add(fmt::format("running_impulse{}_Ns", number), trace.running_impulse_Ns);
    add(fmt::format("in_contact{}", number), closed.back());
    add(fmt::format("displacement_{}1_m", contact), trace.displacement_1_m);
    add(fmt::format("displacement_{}2_m", contact), trace.displacement_2_m);
    add(fmt::format("stored{}_J", number), trace.stored_J);
    add(fmt::format("dissipated{}_J", number), trace.dissipated_J);
    add(fmt::format("work_{}1_J", contact), trace.work_1_J);
    add(fmt::format("work_{}2_J", contact), trace.work_2_J);
    add(fmt::format("energy_balance{}_J", number), balance.back());
  }
  for (const BodyEnergy& body : bodies)
    columns.push_back({fmt::format("translational_energy_{}_J", body.body), body.translational_J});
  write_csv(path, columns);
}

void write_intervals(const std::string& path, const UniformGrid& grid, const std::vector<ContactTrace>& traces) {
  CsvOutput out(path, {"contact", "start_s", "end_s", "peak_force_N", "peak_time_s", "impulse_Ns"});
  for (std::size_t i = 0; i < traces.size(); ++i)
    for (const ContactInterval& interval : contact_intervals(traces[i], grid))
      out.row({static_cast<double>(i + 1), interval.start_s, interval.end_s, interval.peak_force_N,
               interval.peak_time_s, interval.impulse_Ns});
  out.close();
}

namespace {

const std::vector<std::string> summary_names{"peak_force_N", "peak_time_s",           "contact_duration_s",
                                             "impulse_Ns",   "rebound_speed_m_per_s", "energy_error"};

CsvField optional_field(std::optional<double> value) { return value ? CsvField(*value) : CsvField(); }

std::vector<CsvField> summary_fields(const ImpactSummary& line) {
  return {line.peak_force_N,
          line.peak_time_s,
          line.contact_duration_s,
          line.impulse_Ns,
          optional_field(line.rebound_speed_m_per_s),
          line.energy_error};
}

}  // namespace

void write_summary(const std::string& path, const ImpactSummary& line) {
  CsvOutput out(path, summary_names);
  out.row(summary_fields(line));
  out.close();
}

void write_summary(const std::string& path, const ContactsSummary& summary) {
  std::vector<std::string> names = summary_names;
  names.insert(names.end(), {"contact_count", "restitution"});
  std::vector<CsvField> fields = summary_fields(summary.impact);
  fields.push_back(static_cast<double>(summary.contact_count));
  fields.push_back(optional_field(summary.restitution));
  CsvOutput out(path, names);
  out.row(fields);
  out.close();
}

}  // namespace impulse
