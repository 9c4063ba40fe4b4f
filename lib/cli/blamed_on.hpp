#pragma once

#include "lib/cli/config_toml.hpp"
#include "lib/contract/errors.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace impulse {

/// What `function` returns; a std::invalid_argument that it throws becomes a UsageError about `flag`.
/// Verified by: tests/lib/command.test.cpp
template <class Function>
auto blamed_on(const char* flag, Function&& function) {
  try {
    return std::forward<Function>(function)();
  } catch (const std::invalid_argument& error) {
    throw UsageError(flag, error.what());
  }
}

/// What `function` returns; anything that it throws becomes an InputError about `file`, in which a flag is a key.
/// InputErrors pass as they are.
/// Verified by: tests/lib/command.test.cpp
template <class Function>
auto blamed_on(const TomlFile& file, Function&& function) {
  try {
    return std::forward<Function>(function)();
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    const std::string message = error.what();
    throw InputError(file.name, 0, 0, message.substr(message.starts_with("--") ? 2 : 0));
  }
}

}  // namespace impulse
