#pragma once

#include "lib/contract/errors.hpp"

#include <optional>
#include <string>

namespace impulse {

/// Refuses a second output of a tool, `flag`, where --output goes too: one would overwrite the other, or both mix on
/// stdout.
/// @throws UsageError naming the flag. Verified by: tests/tools/ir-plate/wrong-options
inline void require_apart(const char* flag, const std::optional<std::string>& second, const std::string& output) {
  const auto standard = [](const std::string& path) { return path.empty() || path == "-"; };
  if (second && (*second == output || (standard(*second) && standard(output))))
    throw UsageError(flag, "goes where the output goes (-o); give one of them a file of its own");
}

}  // namespace impulse
