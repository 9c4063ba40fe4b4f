#pragma once

#include <cstddef>
#include <string_view>

namespace impulse {

/// A decimal number at the beginning of a text; `length` characters were read, 0 if there is no number.
struct Decimal {
  double value = 0;
  std::size_t length = 0;
};

/// Reads `[+-]digits[.digits][e[+-]digits]` whatever the locale; infinities and NaN spelled out do not count as
/// numbers. A number too small for a double reads as 0, one too large as infinity: the caller asks for a finite one.
/// Verified by: tests/lib/csv_table.test.cpp
[[nodiscard]] Decimal leading_decimal(std::string_view text);

}  // namespace impulse
