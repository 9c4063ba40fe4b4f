#pragma once

#include "fem/bodies/beam_structure.hpp"
#include "lib/cli/command.hpp"
#include "lib/material/beam.hpp"

#include <optional>
#include <vector>

namespace impulse {

/// The options that describe a beam (body "beam"), on the command line of `ir-beam` or as the keys of a body file.
class BeamOptions {
 public:
  void declare(Command& command);

  /// The beam that was described. @throws UsageError naming the option at fault, std::invalid_argument.
  [[nodiscard]] Beam beam() const;

  /// Whether finite elements are named; `model` has Hermite elements if not.
  [[nodiscard]] bool names_element() const { return element_.has_value(); }
  [[nodiscard]] BeamModel model() const;

 private:
  double length_m_ = 0;
  double width_m_ = 0;
  double height_m_ = 0;
  std::optional<Material> material_;
  BeamSupports supports_ = BeamSupports::simple;
  std::vector<double> at_;
  std::optional<BeamElement> element_;
  std::optional<Quadrilateral> quadrilateral_;
  std::optional<double> patch_length_m_;
};

}  // namespace impulse
