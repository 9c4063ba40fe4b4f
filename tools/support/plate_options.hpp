#pragma once

#include "impulse/bodies/missing_answer.hpp"
#include "impulse/bodies/ritz_plate.hpp"
#include "lib/cli/command.hpp"
#include "lib/cli/laminate_options.hpp"

#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// A plate as it is struck.
struct StruckPlate {
  DenseStructure structure;              ///< with a contact for every point struck: a patch, or a point of a thin plate
  std::optional<MissingAnswer> missing;  ///< of a thin plate under point forces
};

/// The options that describe a plate (body "plate") and where it is struck, on the command line of `ir-plate` or as the
/// keys of a body file.
class PlateOptions {
 public:
  void declare(Command& command);

  /// The plate that was described; reads the file of edge springs.
  /// @throws UsageError naming the option; InputError for the file of springs.
  [[nodiscard]] RitzPlate plate() const;

  /// @throws UsageError for a point outside, a patch that leaves the plate, and a point force in shear theory.
  [[nodiscard]] StruckPlate struck(const RitzPlate& plate) const;

  /// What there is to say about a patch so small that the deflection under it, whose static flexibility is given, is a
  /// matter of the number of terms: shear theory yields to it like ln(1/radius). Worth a percent at least.
  /// See docs/decisions/0023-patches.md.
  [[nodiscard]] std::optional<std::string> patch_doubt(const RitzPlate& plate, std::size_t point,
                                                       double flexibility_m_per_N) const;

  /// Whether the corners go round clockwise, which is accepted but worth telling.
  [[nodiscard]] bool is_clockwise() const;

  [[nodiscard]] std::size_t point_count() const { return at_.size() / 2; }
  [[nodiscard]] std::vector<Eigen::Vector2d> struck_points() const { return reference_points("--at", at_); }

  /// The (ξ, η) of points given as fractions. @throws UsageError naming `flag` for a point outside the plate.
  [[nodiscard]] static std::vector<Eigen::Vector2d> reference_points(const std::string& flag,
                                                                     const std::vector<double>& fractions);

 private:
  [[nodiscard]] PlateShape shape() const;

  std::vector<double> size_m_;
  std::vector<double> corners_m_;
  LaminateOptions laminate_;
  std::string edges_;
  std::optional<std::string> edge_springs_;
  std::vector<double> at_;
  std::size_t terms_ = 16;
  Plate::Theory theory_ = Plate::Theory::shear;
  Plate::InPlane in_plane_ = Plate::InPlane::when_coupled;
  std::optional<double> shear_correction_;
  std::optional<double> patch_radius_m_;
  std::optional<double> curvature_radius_m_;
};

}  // namespace impulse
