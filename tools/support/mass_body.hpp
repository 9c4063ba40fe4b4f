#pragma once

#include "tools/support/body_file.hpp"

namespace impulse {

/// A rigid mass: the file that `ir-mass --config` reads.
[[nodiscard]] DescribedBody read_mass_body(const TomlFile& file);

}  // namespace impulse
