#pragma once

#include "tools/support/body_file.hpp"

namespace impulse {

/// Reads `body = "solid"`: the TOML that `ir-solid --config` reads, by triangles with lumped mass on the mesh that it
/// describes.
[[nodiscard]] DescribedBody read_solid_body(const TomlFile& file);

}  // namespace impulse
