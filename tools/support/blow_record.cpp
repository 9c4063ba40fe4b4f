#include "tools/support/blow_record.hpp"

#include "lib/contract/errors.hpp"
#include "lib/csv/csv_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <future>

namespace impulse {

void BlowRecords::declare(Command& command) {
  command.text("--force-column", force_column_, "NAME", "column of the force");
  command.quantity("--force-scale", force_scale_, "1", Sign::any, "newtons per unit of that column, with its sign");
  motion_.declare(command);
}

Blow BlowRecords::read_blow(const std::string& path, double& step_s) const {
  const CsvTable table = read_csv(path);
  step_s = uniform_time(table, TimeOrigin::any).step_s;
  Blow blow{table.file(), table.column(force_column_), {}};
  for (double& value : blow.force_N) value *= force_scale_;
  motion_.remove_rest_mean(blow.force_N, blow.name, step_s);
  blow.response = motion_.velocity_m_per_s(table, step_s);
  return blow;
}

BlowRecords::Records BlowRecords::read(const std::vector<std::string>& paths) const {
  motion_.require_consistent();
  Records records{0, std::vector<Blow>(paths.size())};
  std::vector<double> steps(paths.size());
  // Reading text is most of the work: two files at a time.
  const auto work = [&](std::size_t first) {
    for (std::size_t k = first; k < paths.size(); k += 2) records.blows[k] = read_blow(paths[k], steps[k]);
  };
  std::future<void> other = std::async(std::launch::async, [&] { work(1); });
  work(0);
  other.get();
  records.step_s = steps.front();
  for (std::size_t k = 1; k < paths.size(); ++k)
    if (std::abs(steps[k] - steps[0]) > 1e-9 * steps[0])
      throw InputError(records.blows[k].name, 0, 0,
                       fmt::format("is sampled every {:.9g} s, {} every {:.9g} s; records must have one step", steps[k],
                                   records.blows[0].name, steps[0]));
  return records;
}

}  // namespace impulse
