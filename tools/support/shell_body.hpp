#pragma once

#include "fem/shell/shell.hpp"
#include "lib/cli/command.hpp"
#include "lib/cli/laminate_options.hpp"

#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// A point as fractions of the sides.
struct PanelFraction {
  double x = 0.5, y = 0.5;
};

/// Reads `0.5,0.25`. @throws std::invalid_argument for another form or a point outside the panel.
[[nodiscard]] PanelFraction parse_panel_fraction(const std::string& text);

/// The options that describe a thin panel, body "shell", on the command line of a tool or as the keys of its file:
/// size, curvature, wall, imperfection, supports, mesh and points of contact.
class ShellOptions {
 public:
  /// What the tool does with the panel.
  enum class Use {
    impact,  ///< mirror images are refused: the impact would be mirrored too
    statics,
  };

  void declare(Command& command, Use use);

  /// @throws UsageError naming the option, std::invalid_argument for what does not fit together.
  [[nodiscard]] ShellPanel panel() const;

  /// Where --at says, the middle if it says nothing; in metres.
  [[nodiscard]] std::vector<PanelPoint> points() const;

 private:
  Use use_ = Use::impact;
  std::vector<double> size_m_;
  LaminateOptions laminate_;
  std::optional<double> radius_m_;
  std::optional<Curvature> curved_along_;
  std::vector<Imperfection::Wave> waves_, squared_waves_;
  std::vector<Imperfection::Power> powers_;
  std::array<EdgeSupport, 4> edges_{};
  std::array<std::size_t, 2> elements_{8, 8};
  double grading_ = 1;
  std::vector<PanelFraction> at_;
};

}  // namespace impulse
