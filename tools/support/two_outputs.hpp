#pragma once

#include "lib/contract/errors.hpp"

#include <optional>
#include <string>

namespace impulse {

/// Refuses --contacts where the history or summary goes too: one would overwrite the other, or both mix on stdout.
/// @throws UsageError
inline void require_apart(const std::optional<std::string>& contacts, const std::string& output) {
  const auto standard = [](const std::string& path) { return path.empty() || path == "-"; };
  if (contacts && (*contacts == output || (standard(*contacts) && standard(output))))
    throw UsageError("--contacts", "goes where the output goes (-o); give one of them a file of its own");
}

}  // namespace impulse
