#pragma once

#include "impulse/measured/response_estimate.hpp"
#include "lib/cli/command.hpp"

#include <string>

namespace impulse {

/// Declares `--regularisation gcv|l-curve|none|NUMBER`.
void declare_regularisation(Command& command, Regularisation& regularisation);

/// ` (gcv)` or ` (l-curve)` after a value that a rule chose, else nothing.
[[nodiscard]] std::string rule_name(Regularisation::Rule rule);

}  // namespace impulse
