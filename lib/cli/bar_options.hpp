#pragma once

#include "lib/cli/command.hpp"
#include "lib/material/profile.hpp"

#include <optional>
#include <string>
#include <vector>

namespace impulse {

/// The options that describe a bar, as a chain (`--segment`, body "bar") or as one cone (`--length --diameters
/// --material`, body "cone"), on the command line of a tool or as the keys of a body file.
class BarOptions {
 public:
  enum class Kind { chain, cone };
  explicit BarOptions(Kind kind) : kind_(kind) {}

  void declare(Command& command);

  [[nodiscard]] FarEnd far_end() const { return far_end_; }

  /// The bar that was described. @throws std::invalid_argument (UsageError naming the option where one is at fault).
  [[nodiscard]] Bar bar() const;

 private:
  Kind kind_;
  std::vector<Segment> segments_;
  double length_m_ = 0;
  std::vector<double> diameters_m_;
  std::optional<Material> material_;
  std::vector<Face> faces_;
  FarEnd far_end_ = FarEnd::free;
};

/// Reads a body file of a bar or cone: the TOML that `ir-bar --config` or `ir-cone --config` reads.
/// @throws InputError for another kind of body and for what is wrong in the file. Verified by: tests/tools/fe-impact/
[[nodiscard]] Bar read_bar_file(const std::string& path);
[[nodiscard]] Bar read_bar_file(const struct TomlFile& file);

}  // namespace impulse
