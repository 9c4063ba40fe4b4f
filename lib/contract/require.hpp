#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace impulse {

/// Throws std::invalid_argument with the formatted message unless `condition` holds; active in every build type.
/// A message reads *problem (why it is one) suggestion* and carries the values.
template <class... Args>
void require(bool condition, fmt::format_string<Args...> message, Args&&... args) {
  if (!condition) throw std::invalid_argument(fmt::format(message, std::forward<Args>(args)...));
}

}  // namespace impulse
