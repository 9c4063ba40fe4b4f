#include "tools/support/shell_body.hpp"

#include "lib/cli/option_readers.hpp"
#include "lib/cli/quantity.hpp"
#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace impulse {
namespace {

std::vector<std::string> parts_of(const std::string& text, std::size_t count, const std::string& form) {
  std::vector<std::string> parts(1);
  for (char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  require(parts.size() == count, "'{}' is not {}", text, form);
  return parts;
}

int whole_number(const std::string& text, std::size_t least) { return static_cast<int>(count_reader(least)(text)); }

Imperfection::Wave parse_wave(const std::string& text) {
  const auto parts = parts_of(text, 3, "AMPLITUDE,M,N such as 0.5mm,1,1");
  return {parse_quantity(parts[0], "m"), whole_number(parts[1], 1), whole_number(parts[2], 1)};
}

Imperfection::Power parse_power(const std::string& text) {
  const auto parts = parts_of(text, 3, "COEFFICIENT,P,Q such as 0.5mm,1,2");
  return {parse_quantity(parts[0], "m"), whole_number(parts[1], 0), whole_number(parts[2], 0)};
}

std::array<std::size_t, 2> parse_elements(const std::string& text) {
  const auto parts = parts_of(text, 2, "NX,NY such as 8,8");
  // A hundred thousand elements are more than a direct factorisation takes.
  std::array<std::size_t, 2> count{};
  for (std::size_t i = 0; i < 2; ++i) {
    count[i] = count_reader(1)(parts[i]);
    require(count[i] <= 200, "{} elements a side are more than a shell takes (200); grade the mesh instead", count[i]);
  }
  return count;
}

}  // namespace

PanelFraction parse_panel_fraction(const std::string& text) {
  const auto parts = parts_of(text, 2, "two fractions of the sides such as 0.5,0.25");
  const PanelFraction at{parse_quantity(parts[0], "1"), parse_quantity(parts[1], "1")};
  require(at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1, "'{}' is outside the panel (fractions are 0 to 1)", text);
  return at;
}

void ShellOptions::declare(Command& command, Use use) {
  use_ = use;
  command.body("shell");
  command
      .quantity("--size", size_m_, "m", Sign::positive,
                "A,B: lengths of the sides along x and y, of arc where they are curved")
      .required();
  laminate_.declare(command);
  command.quantity("--curvature-radius", radius_m_, "m", Sign::any,
                   "R > 0: the convex side is struck, R < 0: the concave one (default: flat)");
  command.choice<Curvature>("--curved-along", curved_along_,
                            {{"x", Curvature::along_x}, {"y", Curvature::along_y}, {"both", Curvature::both}},
                            "which side is an arc (default: y, a cylinder with its axis along x); both: a sphere");
  command.parsed<Imperfection::Wave>(
      "--imperfection", waves_, parse_wave, "AMPLITUDE,M,N",
      "stress-free, AMPLITUDE sin(M pi x/A) sin(N pi y/B) in the direction of the impact");
  command.parsed<Imperfection::Wave>("--imperfection-squared", squared_waves_, parse_wave, "AMPLITUDE,M,N",
                                     "stress-free, AMPLITUDE sin^2(M pi x/A) sin^2(N pi y/B) in the direction of the "
                                     "impact: level at the edges");
  command.parsed<Imperfection::Power>("--imperfection-power", powers_, parse_power, "COEFFICIENT,P,Q",
                                      "stress-free, COEFFICIENT (x/A)^P (y/B)^Q in the direction of the impact");
  const std::string letters =
      "four letters, for y = 0, x = A, y = B, x = 0: C clamped; F free; I all displacements 0 (H the same); S "
      "deflection and displacement across the edge 0; T deflection and displacement along it 0; W deflection 0";
  command
      .parsed<std::array<EdgeSupport, 4>>(
          "--edges", edges_, parse_edges, "LETTERS",
          use == Use::statics ? letters + "; Y symmetric: the panel is a half or a quarter" : letters)
      .required();
  command.parsed<std::array<std::size_t, 2>>("--elements", elements_, parse_elements, "NX,NY",
                                             "finite elements along x and y (default: 8,8)");
  command.quantity("--grading", grading_, "1", Sign::positive,
                   "longest element per shortest, which is at the first point --at");
  command.parsed<PanelFraction>("--at", at_, parse_panel_fraction, "FX,FY",
                                use == Use::statics
                                    ? "point as fractions of the sides (default: 0.5,0.5); the first is loaded"
                                    : "point of contact as fractions of the sides (default: 0.5,0.5)");
}

std::vector<PanelPoint> ShellOptions::points() const {
  std::vector<PanelPoint> points;
  for (const PanelFraction& at : at_) points.push_back({at.x * size_m_.at(0), at.y * size_m_.at(1)});
  if (points.empty()) points.push_back({size_m_.at(0) / 2, size_m_.at(1) / 2});
  return points;
}

ShellPanel ShellOptions::panel() const {
  if (size_m_.size() != 2)
    throw UsageError("--size", fmt::format("{} lengths for the two sides of a panel; give A,B", size_m_.size()));
  if (curved_along_ && !radius_m_) throw UsageError("--curved-along", "means nothing without --curvature-radius");
  if (grading_ < 1) throw UsageError("--grading", fmt::format("{} is below 1", grading_));
  if (use_ == Use::impact && std::find(edges_.begin(), edges_.end(), EdgeSupport::symmetric) != edges_.end())
    throw UsageError("--edges", "Y would mirror the impact too; describe the whole panel");
  ShellPanel panel;
  panel.shape.length_m = size_m_[0];
  panel.shape.width_m = size_m_[1];
  if (radius_m_) {
    panel.shape.curvature = curved_along_.value_or(Curvature::along_y);
    panel.shape.radius_m = *radius_m_;
  }
  panel.shape.imperfection = {waves_, squared_waves_, powers_};
  panel.laminate = laminate_.laminate();
  panel.edges = edges_;
  const PanelPoint struck = points().front();
  panel.lines_x = graded_lines(size_m_[0], elements_[0], struck.x_m, grading_);
  panel.lines_y = graded_lines(size_m_[1], elements_[1], struck.y_m, grading_);
  require_valid(panel);
  return panel;
}

}  // namespace impulse
