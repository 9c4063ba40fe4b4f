#include "lib/cli/option_readers.hpp"

#include "lib/cli/quantity.hpp"
#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/csv/output_file.hpp"

#include <charconv>
#include <stdexcept>

namespace impulse {
namespace {

void require_sign(double value, const std::string& text, Sign sign) {
  require(sign != Sign::positive || value > 0, "'{}' is not positive", text);
  require(sign != Sign::non_negative || value >= 0, "'{}' is negative", text);
}

}  // namespace

std::function<double(const std::string&)> quantity_reader(const std::string& unit, Sign sign) {
  return [unit, sign](const std::string& text) {
    const double value = parse_quantity(text, unit);
    require_sign(value, text, sign);
    return value;
  };
}

std::function<std::size_t(const std::string&)> count_reader(std::size_t least) {
  return [least](const std::string& text) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    require(error == std::errc() && end == text.data() + text.size(), "'{}' is not a whole number", text);
    require(value >= least, "{} is too small (at least {})", value, least);
    return value;
  };
}

std::string writable_path(const std::string& text) {
  require(!text.empty(), "the name of the file is empty");
  try {
    require_writable(text);
  } catch (const OutputError& error) {
    throw std::invalid_argument(error.what());
  }
  return text;
}

}  // namespace impulse
