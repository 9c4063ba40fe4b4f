#pragma once

#include <string>
#include <string_view>

namespace impulse {

/// Reads a physical quantity and returns its value in `unit`.
///
/// `text` is a decimal number with an optional unit right behind it or after blanks: `400mm`, `2.8GPa`, `10us`,
/// `1150kg/m3`, `0.5ft.lbf`, `20Mpsi`. A bare number is in `unit`, which is SI. Units are those of UDUNITS-2, with its
/// prefixes; its database is loaded at the first suffix only. `unit` may be `1` (a plain number) and may have one
/// length under a power 3/2, `N/m^1.5`: UDUNITS knows integer exponents only, so that length is converted here and
/// raised. Hz and rad/s do not convert into each other: UDUNITS would count 1 Hz as 1 rad/s.
/// @throws std::invalid_argument if the number is missing or not finite, the unit unknown or of another dimension; the
/// message holds the text, what is expected and an example.
/// Verified by: tests/lib/quantity.test.cpp
[[nodiscard]] double parse_quantity(std::string_view text, const std::string& unit);

/// What a quantity in `unit` is called and what one looks like: `a length such as 400mm`.
[[nodiscard]] std::string quantity_description(const std::string& unit);

}  // namespace impulse
