#pragma once

#include "lib/cli/bar_options.hpp"
#include "lib/cli/command.hpp"

namespace impulse {

/// The whole of `ir-bar` and `ir-cone`: a bar's response or modes, by waves or by modes, exact or finite-element ones.
[[nodiscard]] int run_bar_tool(int argc, char** argv, ToolPage page, BarOptions::Kind kind);

}  // namespace impulse
