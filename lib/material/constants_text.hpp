#pragma once

#include <string>
#include <vector>

namespace impulse {

/// The parts of `E:rho:nu`, empty ones included.
[[nodiscard]] std::vector<std::string> split_at_colons(const std::string& text);

/// Whether a text begins as constants do rather than as a name does.
[[nodiscard]] bool looks_like_number(const std::string& text);

/// A quantity in SI `unit` (parse_quantity). @throws std::invalid_argument whose message begins with `what`.
[[nodiscard]] double constant(const std::string& text, const std::string& unit, const char* what);

/// As constant(), and positive.
[[nodiscard]] double positive_constant(const std::string& text, const std::string& unit, const char* what);

}  // namespace impulse
