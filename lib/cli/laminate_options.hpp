#pragma once

#include "lib/cli/command.hpp"
#include "lib/material/laminate.hpp"

#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// The options that describe the wall of a plate or shell, on the command line of a tool or as keys of a body file:
/// `--layup --ply` with `--thickness` (total) or `--ply-thickness`, or `--material --thickness`.
/// Verified by: tests/lib/laminate_options.test.cpp
class LaminateOptions {
 public:
  void declare(Command& command);

  /// Layers from z = -h/2 on; one for a material.
  /// @throws UsageError naming the option that is missing, of no use or wrong, for plies that do not fill the thickness
  /// too.
  [[nodiscard]] std::vector<Layer> layers() const;
  [[nodiscard]] Laminate laminate() const { return impulse::laminate(layers()); }

 private:
  [[nodiscard]] double total_thickness_m(std::size_t ply_count) const;

  std::optional<std::string> layup_;
  std::optional<Ply> ply_;
  std::optional<Material> material_;
  std::optional<double> thickness_m_;
  std::optional<double> ply_thickness_m_;
};

}  // namespace impulse
