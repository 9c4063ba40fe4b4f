#pragma once

#include "tools/support/body_file.hpp"

namespace impulse {

/// A beam: the file that `ir-beam --config` reads, by its elements (Hermite unless the file says otherwise) with lumped
/// mass.
[[nodiscard]] DescribedBody read_beam_body(const TomlFile& file);

}  // namespace impulse
