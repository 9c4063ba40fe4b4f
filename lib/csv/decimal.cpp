#include "lib/csv/decimal.hpp"

#include <charconv>
#include <limits>

namespace impulse {

Decimal leading_decimal(std::string_view text) {
  const std::size_t plus = text.starts_with('+') ? 1 : 0;
  const std::string_view number = text.substr(plus);
  // Without this, from_chars would read "inf" and "nan", and "+-1" would be a number.
  const std::size_t first = !plus && number.starts_with('-') ? 1 : 0;
  if (number.size() <= first || !(number[first] == '.' || (number[first] >= '0' && number[first] <= '9'))) return {};

  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error == std::errc::invalid_argument) return {};
  const auto length = static_cast<std::size_t>(end - number.data());
  if (error == std::errc::result_out_of_range) {
    const std::string_view read = number.substr(0, length);
    const bool tiny = read.find("e-") != read.npos || read.find("E-") != read.npos;
    value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  return {value, length + plus};
}

}  // namespace impulse
