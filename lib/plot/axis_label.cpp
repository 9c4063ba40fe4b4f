#include "lib/plot/axis_label.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace impulse {

ColumnMeaning column_meaning(const std::string& column) {
  struct Unit {
    std::string_view suffix, unit;
  };
  // Longer suffixes first: _m_per_s ends in _s.
  static constexpr std::array units{
      Unit{"_1_per_sqrt_kg", "1/√kg"},
      Unit{"_per_sqrt_kg", "1/√kg"},
      Unit{"_m_per_Ns", "m/(N s)"},
      Unit{"_m_per_s2", "m/s²"},
      Unit{"_m_per_s", "m/s"},
      Unit{"_m_per_N", "m/N"},
      Unit{"_N_per_m", "N/m"},
      Unit{"_kg_per_s", "kg/s"},
      Unit{"_per_kg", "1/kg"},
      Unit{"_Hz", "Hz"},
      Unit{"_Ns", "N s"},
      Unit{"_kg", "kg"},
      Unit{"_Pa", "Pa"},
      Unit{"_N", "N"},
      Unit{"_J", "J"},
      Unit{"_W", "W"},
      Unit{"_m", "m"},
      Unit{"_s", "s"},
  };
  ColumnMeaning meaning{column, ""};
  for (const Unit& unit : units) {
    if (!column.ends_with(unit.suffix) || column.size() == unit.suffix.size()) continue;
    meaning = {column.substr(0, column.size() - unit.suffix.size()), std::string(unit.unit)};
    break;
  }
  std::replace(meaning.quantity.begin(), meaning.quantity.end(), '_', ' ');
  return meaning;
}

std::string axis_label(const ColumnMeaning& meaning) {
  return meaning.unit.empty() ? meaning.quantity : meaning.quantity + " (" + meaning.unit + ")";
}

ScaledUnit readable_time_unit(double largest_s) {
  if (largest_s == 0 || largest_s >= 1) return {"s", 1};
  if (largest_s >= 1e-3) return {"ms", 1e3};
  if (largest_s >= 1e-6) return {"µs", 1e6};
  return {"ns", 1e9};
}

}  // namespace impulse
