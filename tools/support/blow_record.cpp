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
  command.choice<Motion>("--motion", motion_,
                         {{"velocity", Motion::velocity},
                          {"acceleration", Motion::acceleration},
                          {"displacement", Motion::displacement},
                          {"strain", Motion::strain}},
                         "what the transducer measures; acceleration is integrated, displacement differentiated");
  command.text("--motion-column", motion_column_, "NAME",
               "its column (default: velocity_m_per_s, acceleration_m_per_s2, displacement_m or strain)");
  command.quantity("--motion-scale", motion_scale_, "1", Sign::any,
                   "SI units per unit of that column, positive in the force's direction (default: 1); for strain m/s "
                   "per unit, and then required");
  command.quantity(
      "--quiet", quiet_s_, "s", Sign::positive,
      "time at rest at the beginning of every record, whose mean is taken off each channel (default: none)");
}

std::string BlowRecords::motion_column() const {
  if (motion_column_) return *motion_column_;
  switch (motion_) {
    case Motion::velocity:
      return "velocity_m_per_s";
    case Motion::acceleration:
      return "acceleration_m_per_s2";
    case Motion::displacement:
      return "displacement_m";
    case Motion::strain:
      break;
  }
  return "strain";
}

std::vector<double> BlowRecords::velocity(std::vector<double> recorded, double step_s) const {
  for (double& value : recorded) value *= motion_scale_.value_or(1);
  if (motion_ == Motion::acceleration) return cumulative_integral(recorded, step_s);
  if (motion_ == Motion::displacement) return derivative(recorded, step_s);
  return recorded;
}

Blow BlowRecords::read_blow(const std::string& path, double& step_s) const {
  const CsvTable table = read_csv(path);
  step_s = uniform_time(table, TimeOrigin::any).step_s;
  Blow blow{table.file(), table.column(force_column_), table.column(motion_column())};
  for (double& value : blow.force_N) value *= force_scale_;
  if (quiet_s_) {
    const auto count = static_cast<std::size_t>(std::lround(*quiet_s_ / step_s));
    if (count < 1 || count >= blow.force_N.size())
      throw UsageError("--quiet", fmt::format("{:g} s is {} of the {} samples of {}", *quiet_s_, count,
                                              blow.force_N.size(), blow.name));
    remove_offset(blow.force_N, count);
    remove_offset(blow.response, count);
  }
  blow.response = velocity(std::move(blow.response), step_s);
  return blow;
}

BlowRecords::Records BlowRecords::read(const std::vector<std::string>& paths) const {
  if (motion_ == Motion::strain && !motion_scale_)
    throw UsageError("--motion-scale", "is required for strain: the velocity that a unit of its column stands for");
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
