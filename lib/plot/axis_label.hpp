#pragma once

#include <string>

namespace impulse {

/// What a column is about and its unit, both taken from its name: `step_velocity_m_per_Ns` is a step velocity in m/(N
/// s).
struct ColumnMeaning {
  std::string quantity;  ///< underscores are blanks
  std::string unit;      ///< empty if the name ends in none that is known
};

/// Verified by: tests/lib/axis_label.test.cpp
[[nodiscard]] ColumnMeaning column_meaning(const std::string& column);

/// `force (N)`, or the quantity alone if there is no unit.
[[nodiscard]] std::string axis_label(const ColumnMeaning& meaning);

/// A unit and how many of it make one of the SI unit: {"µs", 1e6}.
struct ScaledUnit {
  std::string unit;
  double per_si = 1;
};

/// The unit of time, from s down to ns, in which `largest_s` lies from 1 to 1000; s for 0.
[[nodiscard]] ScaledUnit readable_time_unit(double largest_s);

}  // namespace impulse
