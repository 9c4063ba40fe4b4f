#pragma once

#include "lib/cli/command.hpp"

#include <functional>

namespace impulse {

/// Runs a tool: reads its command line, calls `body`, and turns exceptions, which are caught here and nowhere else,
/// into one line `name: message` on stderr and the exit code: 2 for wrong usage or input, 1 for any other failure, 0
/// when the reader of a pipe has left. The code is else that of `body`, or 1 if stdout cannot be written.
[[nodiscard]] int run_tool(int argc, char** argv, Command& command, const std::function<int()>& body);

}  // namespace impulse
