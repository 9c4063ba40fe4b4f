#pragma once

#include "lib/cli/command.hpp"

#include <cstddef>
#include <functional>
#include <string>

namespace impulse {

/// What turns the text of an option into its value, for Command; all throw std::invalid_argument with the message.
/// Verified by: tests/lib/command.test.cpp
[[nodiscard]] std::function<double(const std::string&)> quantity_reader(const std::string& unit, Sign sign);
[[nodiscard]] std::function<std::size_t(const std::string&)> count_reader(std::size_t least);

/// The path itself, if a file can be written there (require_writable).
[[nodiscard]] std::string writable_path(const std::string& text);

}  // namespace impulse
