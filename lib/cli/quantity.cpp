#include "lib/cli/quantity.hpp"

#include "lib/cli/unit_system.hpp"
#include "lib/contract/require.hpp"
#include "lib/csv/decimal.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace impulse {
namespace {

constexpr std::string_view three_halves = "^1.5";

// UDUNITS reads "m^1.5" as "m^1 times 5", and "m 3" or "m*3" as 3 m: what it would misread is not a unit here.
bool is_plain_unit(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char next = i + 1 < text.size() ? text[i + 1] : '\0';
    const bool digit_next = std::isdigit(static_cast<unsigned char>(next)) != 0;
    if (std::isspace(static_cast<unsigned char>(text[i])) || text[i] == '@') return false;
    if (digit_next && (text[i] == '.' || text[i] == '*' || text[i] == '(')) return false;
  }
  return !text.empty() && !std::isdigit(static_cast<unsigned char>(text[0])) && text[0] != '/' && text[0] != '^';
}

Unit parse_suffix(const std::string& text) { return is_plain_unit(text) ? parse_unit(text) : nullptr; }

/// Value of one `from` in `to`, nothing if the dimensions differ.
std::optional<double> conversion_factor(const ut_unit* from, const std::string& to_name) {
  const Unit to = parse_unit(to_name);
  if (!to) throw std::logic_error("unknown target unit " + to_name);
  const UnitConverter converter = unit_converter(from, to.get());
  if (!converter || cv_convert_double(converter.get(), 0.0) != 0) return std::nullopt;
  return cv_convert_double(converter.get(), 1.0);
}

struct Fraction {
  std::string numerator;
  std::string length;
};

/// Splits `N/m^1.5` into `N` and `m`.
std::optional<Fraction> three_halves_fraction(const std::string& unit) {
  const std::size_t slash = unit.rfind('/');
  if (!unit.ends_with(three_halves) || slash == std::string::npos || slash == 0) return std::nullopt;
  return Fraction{unit.substr(0, slash), unit.substr(slash + 1, unit.size() - slash - 1 - three_halves.size())};
}

[[noreturn]] void refuse(std::string_view text, const std::string& problem, const std::string& unit) {
  throw std::invalid_argument(fmt::format("'{}': {}: expected {}", text, problem, quantity_description(unit)));
}

double suffix_factor(std::string_view text, const std::string& suffix, const std::string& unit) {
  if (suffix.size() > 1 && suffix[0] == ',' && std::isdigit(static_cast<unsigned char>(suffix[1])))
    refuse(text, "the decimal sign is a point", unit);
  if (unit == "1" || unit.empty()) refuse(text, fmt::format("unexpected '{}' after the number", suffix), unit);
  const std::optional<Fraction> wanted = three_halves_fraction(unit);
  const std::optional<Fraction> given = three_halves_fraction(suffix);
  if (wanted.has_value() != given.has_value()) {
    const bool known = given.has_value() || parse_suffix(suffix) != nullptr;
    refuse(text, known ? "wrong dimension" : fmt::format("unknown unit '{}'", suffix), unit);
  }
  const auto factor = [&](const std::string& from_name, const std::string& to_name) {
    const Unit from = parse_suffix(from_name);
    if (!from) refuse(text, fmt::format("unknown unit '{}'", from_name), unit);
    const std::optional<double> value = conversion_factor(from.get(), to_name);
    if (!value) refuse(text, "wrong dimension", unit);
    return *value;
  };
  if (!wanted) return factor(suffix, unit);
  return factor(given->numerator, wanted->numerator) / std::pow(factor(given->length, wanted->length), 1.5);
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

}  // namespace

std::string quantity_description(const std::string& unit) {
  struct Known {
    std::string_view unit, description;
  };
  static constexpr std::array known{
      Known{"m", "a length such as 400mm"},
      Known{"kg", "a mass such as 2.5lb"},
      Known{"s", "a time such as 10us"},
      Known{"Pa", "a modulus or stress such as 2.8GPa"},
      Known{"kg/m3", "a density such as 1150kg/m3"},
      Known{"m/s", "a speed such as 5m/s"},
      Known{"Hz", "a frequency such as 2kHz"},
      Known{"rad/s", "an angular frequency such as 300rad/s"},
      Known{"rad", "an angle such as 0.5rad"},
      Known{"N", "a force such as 5kN"},
      Known{"J", "an energy such as 0.5ft.lbf"},
      Known{"N/m", "a stiffness such as 2kN/mm"},
      Known{"N/m^1.5", "a stiffness of a 3/2 law such as 1.4e6N/cm^1.5"},
      Known{"1", "a plain number"},
  };
  for (const Known& entry : known)
    if (entry.unit == unit) return std::string(entry.description);
  return unit.empty() ? "a plain number" : "a quantity in " + unit;
}

double parse_quantity(std::string_view text, const std::string& unit) {
  const std::string_view whole = trimmed(text);
  const Decimal number = leading_decimal(whole);
  if (whole.empty()) refuse(text, "empty", unit);
  if (number.length == 0) refuse(text, "not a number", unit);
  if (!std::isfinite(number.value)) refuse(text, "too large for a number", unit);
  const std::string suffix(trimmed(whole.substr(number.length)));
  if (suffix.empty()) return number.value;
  const double value = number.value * suffix_factor(text, suffix, unit);
  if (!std::isfinite(value)) refuse(text, "too large for a number", unit);
  return value;
}

}  // namespace impulse
