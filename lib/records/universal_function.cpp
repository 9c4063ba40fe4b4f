#include "lib/records/universal_function.hpp"

#include "lib/contract/errors.hpp"
#include "lib/csv/decimal.hpp"
#include "lib/records/record_unit.hpp"
#include "lib/records/text_encoding.hpp"
#include "lib/records/text_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace impulse {
namespace {

struct Quantity {
  int number;
  const char *name, *si;
  int length, force, temperature;
};

// Specific data types; mass is force times time squared over length in the format's system of length, force and
// temperature.
constexpr std::array quantities{
    Quantity{2, "stress", "Pa", -2, 1, 0},     Quantity{3, "strain", "1", 0, 0, 0},
    Quantity{8, "displacement", "m", 1, 0, 0}, Quantity{9, "reaction force", "N", 0, 1, 0},
    Quantity{11, "velocity", "m/s", 1, 0, 0},  Quantity{12, "acceleration", "m/s2", 1, 0, 0},
    Quantity{13, "force", "N", 0, 1, 0},       Quantity{15, "pressure", "Pa", -2, 1, 0},
    Quantity{16, "mass", "kg", -1, 1, 0},      Quantity{17, "time", "s", 0, 0, 0},
    Quantity{18, "frequency", "Hz", 0, 0, 0},  Quantity{21, "sound pressure", "Pa", -2, 1, 0}};

const Quantity* find_quantity(int number) {
  const auto* const found =
      std::find_if(quantities.begin(), quantities.end(), [&](const Quantity& q) { return q.number == number; });
  return found == quantities.end() ? nullptr : found;
}

constexpr std::string_view exact_tag = "ir-convert: start ";

std::string text_of(std::string_view bytes) {
  const std::string text(trimmed_field(bytes));
  return to_utf8(text, text_encoding(text));
}

std::string named(std::string_view field) {
  const std::string text = text_of(field);
  return is_no_unit(text) ? "" : text;
}

int whole_number(std::string_view field) {
  const std::optional<double> value = field_number(field, '.');
  return value && std::abs(*value) < 1e9 ? static_cast<int>(*value) : 0;
}

UniversalAxis read_axis(std::string_view line) {
  UniversalAxis axis;
  axis.quantity = whole_number(columns_of(line, 0, 10));
  axis.length_exponent = whole_number(columns_of(line, 10, 5));
  axis.force_exponent = whole_number(columns_of(line, 15, 5));
  axis.temperature_exponent = whole_number(columns_of(line, 20, 5));
  axis.label = named(columns_of(line, 26, 20));
  axis.unit = named(columns_of(line, 47, 20));
  return axis;
}

/// `12+Z`: node and direction; "" if neither is said.
std::string point(std::string_view node, std::string_view direction) {
  static constexpr std::array directions{"", "X", "Y", "Z", "RX", "RY", "RZ"};
  const int number = whole_number(node), way = whole_number(direction);
  if (number <= 0) return "";
  const auto axis = static_cast<std::size_t>(std::abs(way));
  return fmt::format("{}{}{}", number,
                     way > 0   ? "+"
                     : way < 0 ? "-"
                               : "",
                     axis < directions.size() ? directions[axis] : "");
}

std::string line_of(UniversalCursor& cursor, const std::string& file) {
  std::string_view line;
  if (!cursor.next_line(line)) throw InputError(file, cursor.line() + 1, 0, "the heading of dataset 58 breaks off");
  return std::string(line);
}

void read_data_form(std::string_view line, UniversalFunction& function, const std::string& file, std::size_t number) {
  std::array<double, 5> fields{};
  for (double& field : fields) {
    const std::optional<double> value = take_number(line);
    if (!value)
      throw InputError(file, number, 0, fmt::format("'{}' is no number in record 7 of dataset 58", line.substr(0, 40)));
    field = *value;
  }
  const double type = fields[0], count = fields[1];
  if (type != 2 && type != 4 && type != 5 && type != 6)
    throw InputError(file, number, 0, fmt::format("data type {} of dataset 58 (2, 4, 5 and 6 are known)", type));
  if (!(count >= 1 && count < 1e15) || count != std::floor(count))
    throw InputError(file, number, 0, fmt::format("{} samples in dataset 58", count));
  function.is_complex = type >= 5;
  function.is_double = type == 4 || type == 6;
  function.is_even = fields[2] != 0;
  function.count = static_cast<std::size_t>(count);
  function.start = fields[3];
  function.step = fields[4];
  if (function.is_even && !(function.step > 0 && std::isfinite(function.step) && std::isfinite(function.start)))
    throw InputError(file, number, 0, fmt::format("the step of an even abscissa is {}", function.step));
}

/// Takes start and step with all digits, if the fourth line has them and they are those of record 7.
void take_exact_abscissa(UniversalFunction& function) {
  std::string_view text = function.id[3];
  if (!function.is_even || !text.starts_with(exact_tag)) return;
  text.remove_prefix(exact_tag.size());
  const std::optional<double> start = take_number(text);
  if (!start || !text.starts_with(" step ")) return;
  text.remove_prefix(6);
  const std::optional<double> step = take_number(text);
  const auto close = [](double exact, double rounded) { return std::abs(exact - rounded) <= 1e-5 * std::abs(exact); };
  if (!step || !close(*step, function.step) || !close(*start, function.start)) return;
  function.start = *start;
  function.step = *step;
}

}  // namespace

std::string UniversalAxis::quantity_name() const {
  const Quantity* known = find_quantity(quantity);
  return known ? known->name : "";
}

std::string UniversalAxis::si_unit() const {
  const Quantity* known = find_quantity(quantity);
  return known ? known->si : "";
}

double UniversalAxis::divisor(const UniversalUnits& units) const {
  const bool says_none = length_exponent == 0 && force_exponent == 0 && temperature_exponent == 0;
  const Quantity* known = find_quantity(quantity);
  const int length = says_none && known ? known->length : length_exponent;
  const int force = says_none && known ? known->force : force_exponent;
  const int temperature = says_none && known ? known->temperature : temperature_exponent;
  return std::pow(units.length, length) * std::pow(units.force, force) * std::pow(units.temperature, temperature);
}

UniversalFunction read_universal_heading(UniversalCursor& cursor, const std::string& file) {
  UniversalFunction function;
  for (std::string& id : function.id) id = text_of(line_of(cursor, file));
  const std::string identification = line_of(cursor, file);
  function.function_type = whole_number(columns_of(identification, 0, 5));
  function.response_name = named(columns_of(identification, 31, 10));
  function.response_point = point(columns_of(identification, 41, 10), columns_of(identification, 51, 4));
  function.reference_point = point(columns_of(identification, 66, 10), columns_of(identification, 76, 4));
  const std::string form = line_of(cursor, file);
  read_data_form(form, function, file, cursor.line());
  function.abscissa = read_axis(line_of(cursor, file));
  function.numerator = read_axis(line_of(cursor, file));
  function.denominator = read_axis(line_of(cursor, file));
  (void)line_of(cursor, file);
  take_exact_abscissa(function);
  return function;
}

std::string exact_abscissa_text(const Abscissa& abscissa) {
  return fmt::format("{}{} step {}", exact_tag, abscissa.start, abscissa.step);
}

UniversalChannel universal_channel(const UniversalFunction& function, const std::optional<UniversalUnits>& units) {
  const UniversalAxis &above = function.numerator, &below = function.denominator;
  UniversalChannel channel;
  ChannelInfo& info = channel.info;
  info.is_complex = function.is_complex;
  info.quantity = above.quantity_name();
  const std::string points = function.reference_point.empty()
                                 ? function.response_point
                                 : function.response_point + "/" + function.reference_point;
  if (function.id[3].starts_with(exact_tag))
    info.name = function.id[0];
  else if (!function.response_name.empty())
    info.name = function.response_name;
  else if (!above.label.empty())
    info.name = above.label + (points.empty() ? "" : " " + points);
  else
    info.name = points.empty() ? named(function.id[0]) : points;
  if (info.name.empty()) info.name = "channel";

  const bool is_ratio = !below.unit.empty() || (above.unit.empty() && !below.si_unit().empty());
  if (!above.unit.empty()) {
    info.unit = below.unit.empty() ? above.unit : fmt::format("({})/({})", above.unit, below.unit);
  } else if (units && !above.si_unit().empty()) {
    info.unit = is_ratio ? fmt::format("({})/({})", above.si_unit(), below.si_unit()) : above.si_unit();
    channel.divisor = above.divisor(*units) / (is_ratio ? below.divisor(*units) : 1);
  }
  return channel;
}

double abscissa_factor(const UniversalFunction& function) {
  const std::optional<RecordUnit> unit = record_unit(function.abscissa.unit);
  return unit ? unit->factor : 1;
}

Abscissa universal_abscissa(const UniversalFunction& function) {
  Abscissa abscissa;
  const std::optional<RecordUnit> unit = record_unit(function.abscissa.unit);
  // Functions 2 to 4, 6 and 9 are spectra; 1 is a time response.
  const int type = function.function_type;
  const bool spectrum = (type >= 2 && type <= 4) || type == 6 || type == 9;
  abscissa.unit = unit                                   ? unit->si
                  : !function.abscissa.si_unit().empty() ? function.abscissa.si_unit()
                  : spectrum                             ? "Hz"
                                                         : "s";
  abscissa.name = abscissa.unit == "s" ? "time" : abscissa.unit == "Hz" ? "frequency" : function.abscissa.label;
  if (abscissa.name.empty()) abscissa.name = "abscissa";
  const double factor = abscissa_factor(function);
  abscissa.size = function.count;
  if (function.is_even) {
    abscissa.start = function.start * factor;
    abscissa.step = function.step * factor;
  }
  return abscissa;
}

}  // namespace impulse
