#include "tools/support/published_case.hpp"

#include "lib/cli/bar_options.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_table.hpp"

#include <fmt/format.h>

namespace impulse {

PublishedCase read_published_case(const std::string& folder, const std::string& id) {
  const std::string at = folder + "/" + id + "/";
  PublishedCase result{id, read_bar_file(at + "projectile.toml"), read_bar_file(at + "target.toml"), 0, {}};
  read_config_file(at + "impact.toml", [&](Command& command) {
    command.quantity("--speed", result.speed_m_per_s, "m/s", Sign::positive, "of the projectile").required();
  });
  const CsvTable table = read_csv(at + "published.csv");
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const std::string method = table.text("method", row);
    if (method != "impulse-response" && method != "finite-elements")
      throw InputError(table.file(), table.line(row), table.field("method"),
                       fmt::format("method \"{}\" is neither impulse-response nor finite-elements", method));
    for (const char* column : {"step_s", "cpu_s"})
      if (table.column(column)[row] <= 0)
        throw InputError(table.file(), table.line(row), table.field(column),
                         fmt::format("{} {} is not positive", column, table.column(column)[row]));
    result.runs.push_back({method, table.column("step_s")[row], table.column("cpu_s")[row]});
  }
  return result;
}

}  // namespace impulse
