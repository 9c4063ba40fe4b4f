#include "tools/support/shell_picture.hpp"

#include "fem/shell/shell_geometry.hpp"

#include <fmt/format.h>

#include <functional>

namespace impulse {
namespace {

using Index = Eigen::Index;
constexpr Index parts = 4;  // of an element's side

Index points_along(const std::vector<double>& lines) { return parts * static_cast<Index>(lines.size() - 1) + 1; }

/// What coefficients that are given for each element make at the points.
Eigen::MatrixX3d sampled(const Shell& shell, const std::function<Coefficients(const ShellElement&)>& coefficients) {
  const Index columns = points_along(shell.panel().lines_x), rows = points_along(shell.panel().lines_y);
  Eigen::MatrixX3d values(columns * rows, 3);
  const Index across = (columns - 1) / parts;
  for (std::size_t e = 0; e < shell.elements().size(); ++e) {
    const Coefficients here = coefficients(shell.elements()[e]);
    const Index i = static_cast<Index>(e) % across, j = static_cast<Index>(e) / across;
    for (Index b = 0; b <= parts; ++b)
      for (Index a = 0; a <= parts; ++a)
        values.row((parts * j + b) * columns + parts * i + a) =
            shell_functions(static_cast<double>(a) / parts, static_cast<double>(b) / parts).value.transpose() * here;
  }
  return values;
}

VtuGrid shell_grid(const Shell& shell) {
  const Index columns = points_along(shell.panel().lines_x), rows = points_along(shell.panel().lines_y);
  VtuGrid grid{.points = sampled(shell, [](const ShellElement& element) { return element.surface; }),
               .cells = {},
               .kind = VtuCell::quadrilateral};
  grid.cells.resize((columns - 1) * (rows - 1), 4);
  for (Index j = 0; j + 1 < rows; ++j)
    for (Index i = 0; i + 1 < columns; ++i) {
      const Index corner = j * columns + i;
      grid.cells.row(j * (columns - 1) + i) << corner, corner + 1, corner + columns + 1, corner + columns;
    }
  return grid;
}

}  // namespace

ShellPicture::ShellPicture(const Shell& shell, const std::optional<std::string>& path, std::size_t count,
                           const UniformGrid& grid)
    : shell_(shell), path_(path), count_(count), grid_(grid) {}

void ShellPicture::add(std::size_t sample, const PanelImpact& impact) {
  if (!path_) return;
  // Of the equally spaced moments the one that this sample is the first not to precede.
  const auto moment = [&](std::size_t n) { return n * count_ / (grid_.size - 1); };
  if (moment(sample) == moment(sample - 1)) return;
  const Eigen::VectorXd values = shell_.nodal_values(impact.displacement());
  fields_.push_back({fmt::format("displacement_at_{:g}_s_m", grid_.time_s(sample)),
                     sampled(shell_, [&](const ShellElement& element) { return coefficients_of(element, values); })});
}

void ShellPicture::write() const {
  if (path_) write_vtu(*path_, shell_grid(shell_), fields_);
}

}  // namespace impulse
