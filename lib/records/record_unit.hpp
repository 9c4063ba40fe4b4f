#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace impulse {

/// A unit as records spell it, in SI: SI value = factor · value + offset.
struct RecordUnit {
  std::string si;  ///< `m/s2`, `N s`, `1` for a plain number
  double factor = 1;
  double offset = 0;
};

/// What a unit of a record means. `text` is UTF-8 in the spellings of UDUNITS-2 and of laboratories: `mm/s²`,
/// `(m/s^2)/N`, `µε`, `Volts`, `Nm`. `g` is the acceleration of free fall, not the gram, for that is what
/// accelerometers are calibrated in. Empty if the unit is not known, `EU` for instance. Verified by:
/// tests/lib/record_unit.test.cpp
[[nodiscard]] std::optional<RecordUnit> record_unit(std::string_view text);

/// Whether a unit text says that there is none: "", `NONE`, `-`, `unknown`.
[[nodiscard]] bool is_no_unit(std::string_view text);

/// The SI unit of a product or quotient of two SI units: `V` times `N/V` is `N`.
[[nodiscard]] std::string unit_product(const std::string& a, const std::string& b);
[[nodiscard]] std::string unit_quotient(const std::string& a, const std::string& b);

/// The end of a column's name that says its unit: `_m_per_s2`; "" for a plain number.
[[nodiscard]] std::string unit_suffix(const std::string& si_unit);

/// A heading taken apart: `Force [kN]`, `Time (s)`, `Zeit/s`, `velocity_m_per_s`.
struct Heading {
  std::string name;
  std::string unit;  ///< as spelled; "" if the heading says none
};
[[nodiscard]] Heading parse_heading(std::string_view text);

/// Column of a channel: its name and unit, once: `Mic 01` in Pa is `Mic 01_Pa`, `force_N` in N stays.
[[nodiscard]] std::string column_name(const std::string& name, const std::string& si_unit);

}  // namespace impulse
