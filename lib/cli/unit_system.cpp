#include "lib/cli/unit_system.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace impulse {
namespace {

struct SystemFree {
  void operator()(ut_system* system) const { ut_free_system(system); }
};

// Units that convert are not changed by it; the C interface is just not const-correct.
ut_unit* mutable_unit(const ut_unit* unit) { return const_cast<ut_unit*>(unit); }  // NOLINT

bool has_radian(const ut_unit* unit) {
  std::array<char, 256> text{};
  const int length = ut_format(unit, text.data(), text.size() - 1, UT_ASCII | UT_DEFINITION);
  return length > 0 && std::string_view(text.data()).find("rad") != std::string_view::npos;
}

}  // namespace

ut_system* unit_system() {
  static const std::unique_ptr<ut_system, SystemFree> system = [] {
    ut_set_error_message_handler(ut_ignore);
    return std::unique_ptr<ut_system, SystemFree>(ut_read_xml(nullptr));
  }();
  if (!system) throw std::runtime_error("cannot load the unit database of UDUNITS-2 (is libudunits2-data installed?)");
  return system.get();
}

Unit parse_unit(const std::string& name) { return Unit(ut_parse(unit_system(), name.c_str(), UT_UTF8)); }

bool same_quantity(const ut_unit* a, const ut_unit* b) {
  return ut_are_convertible(a, b) && has_radian(a) == has_radian(b);
}

UnitConverter unit_converter(const ut_unit* from, const ut_unit* to) {
  if (!same_quantity(from, to)) return nullptr;
  UnitConverter converter(ut_get_converter(mutable_unit(from), mutable_unit(to)));
  if (!converter) return nullptr;
  // Convertible to UDUNITS are also reciprocals (s and Hz), which are another quantity here.
  const double zero = cv_convert_double(converter.get(), 0.0);
  const double once = cv_convert_double(converter.get(), 1.0) - zero;
  const double twice = cv_convert_double(converter.get(), 2.0) - zero;
  if (!(std::abs(twice - 2 * once) <= 1e-9 * std::abs(once))) return nullptr;
  return converter;
}

}  // namespace impulse
