#pragma once

#include "impulse/measured/blow.hpp"
#include "lib/cli/command.hpp"
#include "tools/support/motion_record.hpp"

#include <string>
#include <vector>

namespace impulse {

/// The options that say which columns of a record are force and motion; and the reading of records by them.
/// Verified by: tests/tools/ir-estimate/
class BlowRecords {
 public:
  void declare(Command& command);

  struct Records {
    double step_s = 0;
    std::vector<Blow> blows;
  };
  /// Force in N and velocity in m/s of each file, and their common step.
  /// @throws InputError for the file at fault; UsageError for options that do not fit together.
  [[nodiscard]] Records read(const std::vector<std::string>& paths) const;

 private:
  [[nodiscard]] Blow read_blow(const std::string& path, double& step_s) const;

  std::string force_column_ = "force_N";
  double force_scale_ = 1;
  MotionRecord motion_;
};

}  // namespace impulse
