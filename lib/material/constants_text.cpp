#include "lib/material/constants_text.hpp"

#include "lib/cli/quantity.hpp"
#include "lib/contract/require.hpp"

namespace impulse {

std::vector<std::string> split_at_colons(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(':', begin);
    parts.push_back(text.substr(begin, end == std::string::npos ? end : end - begin));
  }
  return parts;
}

bool looks_like_number(const std::string& text) { return !text.empty() && text.find_first_of("0123456789.+-") == 0; }

double constant(const std::string& text, const std::string& unit, const char* what) {
  try {
    return parse_quantity(text, unit);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{} {}", what, error.what()));
  }
}

double positive_constant(const std::string& text, const std::string& unit, const char* what) {
  const double value = constant(text, unit, what);
  require(value > 0, "{} '{}' is not positive", what, text);
  return value;
}

}  // namespace impulse
