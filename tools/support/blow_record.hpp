#pragma once

#include "impulse/measured/blow.hpp"
#include "lib/cli/command.hpp"

#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// What a transducer measured.
enum class Motion { velocity, acceleration, displacement, strain };

/// The options that say which columns of a record are the force and the motion, in which units, and where they are at
/// rest; and the reading of records by them. Verified by: tests/tools/ir-estimate/
class BlowRecords {
 public:
  void declare(Command& command);

  /// Force in N and velocity in m/s of each file, and their common step. Acceleration is integrated, displacement
  /// differentiated, strain scaled.
  /// @throws InputError for the file at fault; UsageError for options that do not fit together.
  struct Records {
    double step_s = 0;
    std::vector<Blow> blows;
  };
  [[nodiscard]] Records read(const std::vector<std::string>& paths) const;

 private:
  [[nodiscard]] std::string motion_column() const;
  [[nodiscard]] std::vector<double> velocity(std::vector<double> recorded, double step_s) const;
  [[nodiscard]] Blow read_blow(const std::string& path, double& step_s) const;

  std::string force_column_ = "force_N";
  double force_scale_ = 1;
  Motion motion_ = Motion::velocity;
  std::optional<std::string> motion_column_;
  std::optional<double> motion_scale_;
  std::optional<double> quiet_s_;
};

}  // namespace impulse
