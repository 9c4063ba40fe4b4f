#pragma once

#include "lib/cli/command.hpp"
#include "lib/csv/csv_table.hpp"

#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// What a transducer measured.
enum class Motion { velocity, acceleration, displacement, strain };

/// The options that say which column of a record is the motion, in which unit, and where it is at rest.
/// Verified by: tests/tools/ir-estimate/
class MotionRecord {
 public:
  void declare(Command& command);

  /// @throws UsageError for options that do not fit together.
  void require_consistent() const;

  /// Velocity in m/s, zero in the mean of the time at rest. Acceleration is integrated, displacement differentiated,
  /// strain scaled. @throws InputError for the file at fault; UsageError for a time at rest that it does not have.
  [[nodiscard]] std::vector<double> velocity_m_per_s(const CsvTable& table, double step_s) const;

  /// Takes the mean of the time at rest off another channel of the same record.
  void remove_rest_mean(std::vector<double>& values, const std::string& file, double step_s) const;

 private:
  [[nodiscard]] std::string column() const;

  Motion motion_ = Motion::velocity;
  std::optional<std::string> column_;
  std::optional<double> scale_;
  std::optional<double> rest_s_;
};

}  // namespace impulse
