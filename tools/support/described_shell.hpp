#pragma once

#include "tools/support/body_file.hpp"

namespace impulse {

/// A thin panel: the file that `ir-shell --config` reads, by its shell elements, small displacements. Their consistent
/// mass is factorised once (MassSolver): row sums of Hermite functions are no masses, for the functions that carry
/// slopes have mass without a row sum. The step must be stable for the mesh of the file.
[[nodiscard]] DescribedBody read_shell_body(const TomlFile& file);

}  // namespace impulse
