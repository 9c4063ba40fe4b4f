#pragma once

#include <cstddef>
#include <limits>

namespace impulse {

/// Which modes of a continuous body, of its infinitely many: the lowest, up to either limit.
struct ModeRange {
  double highest_frequency_Hz = std::numeric_limits<double>::infinity();
  std::size_t count = std::numeric_limits<std::size_t>::max();  ///< rigid-body modes included
};

}  // namespace impulse
