#pragma once

#include "lib/cli/command.hpp"
#include "lib/material/profile.hpp"

#include <vector>

namespace impulse {

/// Options of a rigid mass, for ir-mass and for body files.
struct MassOptions {
  double mass_kg = 0;
  std::vector<Face> faces{Face::a};

  void declare(Command& command);

  /// @throws UsageError for a face given twice.
  void require_valid() const;
};

}  // namespace impulse
