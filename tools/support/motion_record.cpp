#include "tools/support/motion_record.hpp"

#include "impulse/measured/blow.hpp"
#include "lib/contract/errors.hpp"

#include <fmt/format.h>

#include <cmath>

namespace impulse {

void MotionRecord::declare(Command& command) {
  command.choice<Motion>("--motion", motion_,
                         {{"velocity", Motion::velocity},
                          {"acceleration", Motion::acceleration},
                          {"displacement", Motion::displacement},
                          {"strain", Motion::strain}},
                         "what the transducer measures; acceleration is integrated, displacement differentiated");
  command.text("--motion-column", column_, "NAME",
               "its column (default: velocity_m_per_s, acceleration_m_per_s2, displacement_m or strain)");
  command.quantity("--motion-scale", scale_, "1", Sign::any,
                   "SI units per unit of that column, positive in the force's direction (default: 1); for strain m/s "
                   "per unit, and then required");
  command.quantity(
      "--rest", rest_s_, "s", Sign::positive,
      "time at rest at the beginning of every record, whose mean is taken off each channel (default: none)");
}

void MotionRecord::require_consistent() const {
  if (motion_ == Motion::strain && !scale_)
    throw UsageError("--motion-scale", "is required for strain: the velocity that a unit of its column stands for");
}

std::string MotionRecord::column() const {
  if (column_) return *column_;
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

void MotionRecord::remove_rest_mean(std::vector<double>& values, const std::string& file, double step_s) const {
  if (!rest_s_) return;
  const auto count = static_cast<std::size_t>(std::lround(*rest_s_ / step_s));
  if (count < 1 || count >= values.size())
    throw UsageError("--rest",
                     fmt::format("{:g} s is {} of the {} samples of {}", *rest_s_, count, values.size(), file));
  remove_offset(values, count);
}

std::vector<double> MotionRecord::velocity_m_per_s(const CsvTable& table, double step_s) const {
  std::vector<double> recorded = table.column(column());
  for (double& value : recorded) value *= scale_.value_or(1);
  remove_rest_mean(recorded, table.file(), step_s);
  if (motion_ == Motion::acceleration) return cumulative_integral(recorded, step_s);
  if (motion_ == Motion::displacement) return derivative(recorded, step_s);
  return recorded;
}

}  // namespace impulse
