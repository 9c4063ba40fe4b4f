#pragma once

#include "tools/support/body_file.hpp"

namespace impulse {

/// A plate: the file that `ir-plate --config` reads, by the modes of its Ritz series that the step resolves, the others
/// answering statically.
[[nodiscard]] DescribedBody read_plate_body(const TomlFile& file);

}  // namespace impulse
