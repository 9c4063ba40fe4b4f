#pragma once

#include <udunits2.h>

#include <memory>
#include <string>

namespace impulse {

struct UnitFree {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct ConverterFree {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, UnitFree>;
using UnitConverter = std::unique_ptr<cv_converter, ConverterFree>;

/// The unit database of UDUNITS-2, loaded at the first call (3 ms).
/// @throws std::runtime_error if it is not installed.
[[nodiscard]] ut_system* unit_system();

/// A unit by its name in UTF-8, `m/s2` or `kg m-1`; empty if UDUNITS does not know it.
[[nodiscard]] Unit parse_unit(const std::string& name);

/// Whether two units measure the same quantity: of one dimension, and both or neither with an angle, which UDUNITS
/// takes for a plain number (it would count 1 Hz as 1 rad/s).
[[nodiscard]] bool same_quantity(const ut_unit* a, const ut_unit* b);

/// From one unit to another; empty if they do not measure the same quantity, or one is the reciprocal of the other.
[[nodiscard]] UnitConverter unit_converter(const ut_unit* from, const ut_unit* to);

}  // namespace impulse
