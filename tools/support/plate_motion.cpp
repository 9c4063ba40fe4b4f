#include "tools/support/plate_motion.hpp"

#include "impulse/response/modal_coordinates.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_output.hpp"
#include "lib/csv/csv_table.hpp"
#include "tools/support/two_outputs.hpp"

#include <fmt/format.h>

#include <cmath>

namespace impulse {
namespace {

/// Outputs at a point: the deflection, and the strains of both faces.
constexpr Eigen::Index outputs_per_point = 7;

std::vector<std::string> history_names(std::size_t points) {
  std::vector<std::string> names;
  for (std::size_t i = 1; i <= points; ++i) {
    const std::string number = points == 1 ? "" : fmt::format("_{}", i);
    names.push_back(fmt::format("deflection{}_m", number));
    for (const char* face : {"struck", "far"})
      for (const char* direction : {"x", "y", "xy"})
        names.push_back(fmt::format("strain_{}_{}{}", direction, face, number));
  }
  return names;
}

}  // namespace

void PlateMotion::declare(Command& command) {
  command.text("--shapes", shapes_, "FILE",
               "write the modes' deflections on a grid to FILE: x_m, y_m, shape_1_per_sqrt_kg, ...");
  command.text("--under", force_, "FILE",
               "instead of a response, write what this force does (column force_N, of ir-impact say): histories at "
               "--output-at, or the field at --field-times");
  command.quantity("--output-at", output_at_, "1", Sign::any,
                   "point of a history, as --at: deflection, and strains in the plane at the struck and the far face; "
                   "repeat for several");
  command.quantity("--field-times", field_times_s_, "s", Sign::non_negative,
                   "times of the field of deflection: x_m, y_m, deflection_1_m, ...");
  command.count("--grid", grid_, 2, "points a side of the field or the shapes");
}

void PlateMotion::require_consistent(const Command& command, std::size_t point_count, const std::string& output) const {
  require_apart("--shapes", shapes_, output);
  if (!force_) {
    for (const char* flag : {"--output-at", "--field-times"})
      if (command.given(flag)) throw UsageError(flag, "is for the motion under a force; add --under FILE");
    if (command.given("--grid") && !shapes_)
      throw UsageError("--grid", "is for --shapes and --field-times; add one of them");
    return;
  }
  if (shapes_) throw UsageError("--shapes", "and --under are two questions; leave one of them out");
  if (point_count != 1) throw UsageError("--at", fmt::format("is given {} points; --under has one force", point_count));
  if (output_at_.empty() == field_times_s_.empty())
    throw UsageError("--under", "needs --output-at for histories or --field-times for the field, one of them");
  if (command.given("--grid") && field_times_s_.empty())
    throw UsageError("--grid", "is for --shapes and --field-times; add one of them");
  for (const char* flag : {"--as", "--step", "--duration"})
    if (command.given(flag)) throw UsageError(flag, "means nothing to --under, whose file has a grid; leave it out");
}

UniformSeries PlateMotion::force() const {
  const CsvTable table = read_csv(*force_);
  return {uniform_time(table), table.column("force_N")};
}

std::vector<Eigen::Vector2d> PlateMotion::grid_points() const {
  std::vector<Eigen::Vector2d> points;
  const auto at = [this](std::size_t i) { return -1 + 2 * static_cast<double>(i) / static_cast<double>(grid_ - 1); };
  for (std::size_t j = 0; j < grid_; ++j)
    for (std::size_t i = 0; i < grid_; ++i) points.emplace_back(at(i), at(j));
  return points;
}

Eigen::MatrixXd PlateMotion::outputs(const RitzPlate& plate) const {
  if (output_at_.empty()) {
    const std::vector<Eigen::Vector2d> points = grid_points();
    Eigen::MatrixXd result(plate.unknown_count(), static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
      result.col(static_cast<Eigen::Index>(i)) = plate.deflection(points[i]);
    return result;
  }
  const std::vector<Eigen::Vector2d> points = PlateOptions::reference_points("--output-at", output_at_);
  const double face = plate.plate().laminate.thickness_m / 2;
  Eigen::MatrixXd result(plate.unknown_count(), outputs_per_point * static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Index begin = outputs_per_point * static_cast<Eigen::Index>(i);
    result.col(begin) = plate.deflection(points[i]);
    result.middleCols(begin + 1, 3) = plate.strains(points[i], -face);
    result.middleCols(begin + 4, 3) = plate.strains(points[i], face);
  }
  return result;
}

void PlateMotion::write_field(const std::string& path, const RitzPlate& plate, const Eigen::MatrixXd& values,
                              const std::vector<std::string>& names) const {
  std::vector<double> x, y;
  for (const Eigen::Vector2d& at : grid_points()) {
    const Eigen::Vector2d position = plate.plate().shape.position(at);
    x.push_back(position.x());
    y.push_back(position.y());
  }
  std::vector<NamedColumn> columns{{"x_m", x}, {"y_m", y}};
  for (std::size_t i = 0; i < names.size(); ++i)
    columns.push_back({names[i], {values.col(static_cast<Eigen::Index>(i)).data(), x.size()}});
  write_csv(path, columns);
}

Eigen::VectorXd PlateMotion::missing_outputs(const RitzPlate& plate, const MissingAnswer& missing) const {
  if (output_at_.empty()) {
    const std::vector<Eigen::Vector2d> points = grid_points();
    Eigen::VectorXd result(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      result(static_cast<Eigen::Index>(i)) = missing.deflection(points[i])(0);
    return result;
  }
  const std::vector<Eigen::Vector2d> points = PlateOptions::reference_points("--output-at", output_at_);
  const double face = plate.plate().laminate.thickness_m / 2;
  Eigen::VectorXd result(outputs_per_point * static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    result.segment<outputs_per_point>(outputs_per_point * static_cast<Eigen::Index>(i))
        << missing.deflection(points[i])(0),
        missing.strains(points[i], -face).col(0), missing.strains(points[i], face).col(0);
  return result;
}

void PlateMotion::write_shapes(const RitzPlate& plate, const ModalModel& modes) const {
  std::vector<std::string> names;
  for (Eigen::Index i = 1; i <= modes.mode_count(); ++i) names.push_back(fmt::format("shape_{}_per_sqrt_kg", i));
  write_field(*shapes_, plate, modes.output_participation.transpose(), names);
}

void PlateMotion::write_motion(const std::string& path, const RitzPlate& plate, const ModalModel& modes,
                               const UniformSeries& force) const {
  const Eigen::MatrixXd q = modal_coordinates(modes, force);
  if (field_times_s_.empty()) {
    const Eigen::Map<const Eigen::RowVectorXd> f(force.values.data(), q.cols());
    const Eigen::MatrixXd values =
        (modes.output_participation.transpose() * q + modes.residual_outputs * f).transpose();
    std::vector<double> time;
    for (std::size_t k = 0; k < force.grid.size; ++k) time.push_back(force.grid.time_s(k));
    std::vector<NamedColumn> columns{{"time_s", time}};
    const std::vector<std::string> names = history_names(output_at_.size() / 2);
    for (std::size_t i = 0; i < names.size(); ++i)
      columns.push_back({names[i], {values.col(static_cast<Eigen::Index>(i)).data(), time.size()}});
    write_csv(path, columns);
    return;
  }
  Eigen::MatrixXd values(modes.output_participation.cols(), static_cast<Eigen::Index>(field_times_s_.size()));
  std::vector<std::string> names;
  for (std::size_t i = 0; i < field_times_s_.size(); ++i) {
    const double sample = std::round(field_times_s_[i] / force.grid.step_s);
    if (sample >= static_cast<double>(force.grid.size))
      throw UsageError("--field-times", fmt::format("{} s is after the end of the force, {} s", field_times_s_[i],
                                                    force.grid.duration_s()));
    const auto k = static_cast<Eigen::Index>(sample);
    values.col(static_cast<Eigen::Index>(i)) = modes.output_participation.transpose() * q.col(k) +
                                               modes.residual_outputs * force.values[static_cast<std::size_t>(k)];
    names.push_back(fmt::format("deflection_{}_m", i + 1));
  }
  write_field(path, plate, values, names);
}

}  // namespace impulse
