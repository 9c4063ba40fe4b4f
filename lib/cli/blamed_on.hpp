#pragma once

#include "lib/contract/errors.hpp"

#include <stdexcept>
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

}  // namespace impulse
