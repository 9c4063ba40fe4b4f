#pragma once

#include "fem/reduced_basis/panel_impact.hpp"
#include "lib/series/uniform_series.hpp"
#include "lib/vtu/vtu_file.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// The displacements of a shell at equally spaced moments of an impact, the last one the end of the record, as a file
/// for ParaView: 4 × 4 quadrilaterals of the stress-free surface in each element, x fastest, and a field for each
/// moment. Verified by: tests/tools/fe-shell/picture/
class ShellPicture {
 public:
  /// Without a path there is no picture. Keeps a reference to the shell.
  ShellPicture(const Shell& shell, const std::optional<std::string>& path, std::size_t count, const UniformGrid& grid);

  /// To be called at every sample after the start.
  void add(std::size_t sample, const PanelImpact& impact);

  /// What there is. @throws OutputError
  void write() const;

 private:
  const Shell& shell_;
  std::optional<std::string> path_;
  std::size_t count_;
  UniformGrid grid_;
  std::vector<VtuField> fields_;
};

}  // namespace impulse
