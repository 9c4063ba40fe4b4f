#pragma once

#include <string_view>
#include <vector>

namespace impulse {

/// Fibre angles [degrees, from x towards y], first ply first, of a laminate in standard notation:
///
///   layup  = "[" list "]" suffix          list   = item { "/" item }
///   suffix = [ "_" ] [ count ] [ "s" | "T" ]
///   item   = [ sign ] angle [ "_" count ] | ( "[" list "]" | "(" list ")" ) suffix
///   sign   = "+" | "-" | "±" | "+-" | "∓" | "-+"
///
/// `0_2` is two plies; `±45` is +45, -45 and `±45_2` is that pair twice; `]2s` repeats twice and then mirrors; `T` says
/// that the list is all there is, as no letter does. A bar (U+0304 or U+0305) after the last ply of a group in `s`
/// makes it the middle ply, which is not mirrored. Blanks may stand between the parts.
/// Examples: `[±45/0_2/90]s`, `[0/45/0/-45/0]2s`, `[(+-45/0_2)_2/+-45/0/90]_2s`.
/// @throws std::invalid_argument `layup '...': column N: ...`, N counting characters from 1; for more than 100,000
/// plies too. Verified by: tests/lib/layup.test.cpp
[[nodiscard]] std::vector<double> parse_layup(std::string_view text);

}  // namespace impulse
