#pragma once

#include "lib/cli/command.hpp"
#include "lib/model/modal_model.hpp"
#include "lib/series/uniform_series.hpp"
#include "tools/support/plate_options.hpp"

#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// What `ir-plate` shows of a plate beyond its contacts: mode shapes, and the motion under a force: histories of
/// deflection and strains at points, or the field of deflection at some times.
class PlateMotion {
 public:
  void declare(Command& command);

  /// @throws UsageError for options that do not go together.
  void require_consistent(const Command& command, std::size_t point_count, const std::string& output) const;

  [[nodiscard]] bool under_force() const { return force_.has_value(); }
  [[nodiscard]] bool wants_shapes() const { return shapes_.has_value(); }

  /// Reads the force: column force_N on its grid.
  [[nodiscard]] UniformSeries force() const;

  /// Functionals for Structure's outputs: deflections on the grid of the field or shapes, or what histories show.
  [[nodiscard]] Eigen::MatrixXd outputs(const RitzPlate& plate) const;

  /// What the series lack of the outputs' static answer, per N.
  [[nodiscard]] Eigen::VectorXd missing_outputs(const RitzPlate& plate, const MissingAnswer& missing) const;

  void write_shapes(const RitzPlate& plate, const ModalModel& modes) const;
  void write_motion(const std::string& path, const RitzPlate& plate, const ModalModel& modes,
                    const UniformSeries& force) const;

 private:
  [[nodiscard]] std::vector<Eigen::Vector2d> grid_points() const;
  void write_field(const std::string& path, const RitzPlate& plate, const Eigen::MatrixXd& values,
                   const std::vector<std::string>& names) const;

  std::optional<std::string> shapes_;
  std::optional<std::string> force_;
  std::vector<double> output_at_;
  std::vector<double> field_times_s_;
  std::size_t grid_ = 41;
};

}  // namespace impulse
