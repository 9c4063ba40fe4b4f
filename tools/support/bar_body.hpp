#pragma once

#include "tools/support/body_file.hpp"

namespace impulse {

/// A bar or cone: the file that `ir-bar --config` or `ir-cone --config` reads, by bar elements with lumped mass.
[[nodiscard]] DescribedBody read_bar_body(const TomlFile& file);

}  // namespace impulse
