#pragma once

#include "lib/records/record.hpp"
#include "lib/records/universal_text.hpp"

#include <array>
#include <optional>
#include <string>

namespace impulse {

/// Dataset 164: SI value = value / factor.
struct UniversalUnits {
  double length = 1, force = 1, temperature = 1;
};

/// What an axis of dataset 58 says.
struct UniversalAxis {
  int quantity = 0;  ///< specific data type
  int length_exponent = 0, force_exponent = 0, temperature_exponent = 0;
  std::string label, unit;  ///< UTF-8; "" for NONE

  [[nodiscard]] std::string quantity_name() const;
  /// The SI unit of the quantity; "" if it isn't one that has one.
  [[nodiscard]] std::string si_unit() const;
  /// What values are to be divided by for SI.
  [[nodiscard]] double divisor(const UniversalUnits& units) const;
};

/// The eleven lines of text of a dataset 58 or 58b.
struct UniversalFunction {
  std::array<std::string, 5> id;
  int function_type = 0;
  std::string response_name, response_point, reference_point;
  bool is_complex = false, is_double = false, is_even = true;
  std::size_t count = 0;
  double start = 0, step = 0;
  UniversalAxis abscissa, numerator, denominator;

  [[nodiscard]] std::size_t values_per_sample() const { return (is_even ? 0U : 1U) + (is_complex ? 2U : 1U); }
};

/// Reads the eleven lines. @throws InputError at a line of `file` that is missing or wrong.
[[nodiscard]] UniversalFunction read_universal_heading(UniversalCursor& cursor, const std::string& file);

/// Start and step as write_universal_file puts them into the fourth line, with all digits.
[[nodiscard]] std::string exact_abscissa_text(const Abscissa& abscissa);

/// The channel without its values, and by what they are to be divided.
struct UniversalChannel {
  ChannelInfo info;
  double divisor = 1;
};
[[nodiscard]] UniversalChannel universal_channel(const UniversalFunction& function,
                                                 const std::optional<UniversalUnits>& units);

/// Name, unit and grid of the abscissa; its unit's factor is applied to start and step.
[[nodiscard]] Abscissa universal_abscissa(const UniversalFunction& function);

/// By what values of an uneven abscissa are to be multiplied for SI.
[[nodiscard]] double abscissa_factor(const UniversalFunction& function);

}  // namespace impulse
