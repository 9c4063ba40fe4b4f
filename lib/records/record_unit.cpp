#include "lib/records/record_unit.hpp"

#include "lib/cli/unit_system.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <vector>

namespace impulse {
namespace {

// Names of SI units as channels have them, the first that fits wins: Hz and 1/s, J and N m measure the same to UDUNITS.
constexpr std::array si_units{"1",      "m",       "s",   "kg",    "N",     "V",        "Pa",       "m/s",
                              "m/s2",   "Hz",      "rad", "rad/s", "A",     "K",        "J",        "W",
                              "Ohm",    "C",       "F",   "N s",   "kg/m3", "N/m",      "N s/m",    "1/kg",
                              "m/N",    "m/(N s)", "1/N", "V/N",   "V s/m", "m2/s4/Hz", "N2/Hz",    "V2/Hz",
                              "Pa2/Hz", "m2",      "m3",  "1/m",   "T",     "V/m",      "m2/s2/Hz", "rad/s2"};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || (c & 0x80) != 0; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

struct Spelling {
  std::string_view laboratory, udunits;
};

// Words of laboratories that UDUNITS doesn't know or takes for something else.
constexpr std::array spellings{Spelling{"g", "gravity"},    Spelling{"gn", "gravity"},
                               Spelling{"G", "gravity"},    Spelling{"Nm", "N.m"},
                               Spelling{"kNm", "kN.m"},     Spelling{"Ns", "N.s"},
                               Spelling{"volts", "V"},      Spelling{"Volts", "V"},
                               Spelling{"VOLTS", "V"},      Spelling{"Volt", "V"},
                               Spelling{"sec", "s"},        Spelling{"Sec", "s"},
                               Spelling{"SEC", "s"},        Spelling{"msec", "ms"},
                               Spelling{"usec", "us"},      Spelling{"µsec", "us"},
                               Spelling{"secs", "s"},       Spelling{"Seconds", "s"},
                               Spelling{"strain", "1"},     Spelling{"ε", "1"},
                               Spelling{"epsilon", "1"},    Spelling{"με", "1e-6"},
                               Spelling{"µε", "1e-6"},      Spelling{"ue", "1e-6"},
                               Spelling{"ustrain", "1e-6"}, Spelling{"microstrain", "1e-6"},
                               Spelling{"µstrain", "1e-6"}, Spelling{"uε", "1e-6"},
                               Spelling{"mε", "1e-3"},      Spelling{"ohm", "Ohm"},
                               Spelling{"degC", "celsius"}, Spelling{"HZ", "Hz"},
                               Spelling{"hz", "Hz"},        Spelling{"KHz", "kHz"},
                               Spelling{"Samples", "1"},    Spelling{"Unitless", "1"},
                               Spelling{"unitless", "1"},   Spelling{"Newton", "N"},
                               Spelling{"kips", "kip"}};

std::string replaced_word(const std::string& word) {
  for (const Spelling& spelling : spellings)
    if (spelling.laboratory == word) return std::string(spelling.udunits);
  return word;
}

/// Words replaced, `·` and `**` as UDUNITS has them.
std::string in_udunits(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    // A superscript ends a word: its bytes count as letters otherwise.
    const auto superscript = [&](std::size_t at) {
      return text.substr(at).starts_with("²") || text.substr(at).starts_with("³") || text.substr(at).starts_with("·") ||
             text.substr(at).starts_with("⁻") || text.substr(at).starts_with("¹") || text.substr(at).starts_with("°");
    };
    if (is_letter(text[i]) && !superscript(i)) {
      std::size_t end = i;
      while (end < text.size() && is_letter(text[end]) && !superscript(end)) ++end;
      result += replaced_word(std::string(text.substr(i, end - i)));
      i = end;
    } else if (text.substr(i).starts_with("**")) {
      result += '^';
      i += 2;
    } else {
      result += text[i++];
    }
  }
  return result;
}

/// Whether UDUNITS would take a number for a factor: "m 3" and "m*3" are 3 m to it, and "5 N" five newtons.
bool has_factor(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_digit(text[i]) || (i > 0 && (is_digit(text[i - 1]) || is_letter(text[i - 1])))) continue;
    const char before = i == 0 ? ' ' : text[i - 1];
    const bool one_over = text[i] == '1' && i + 1 < text.size() && text[i + 1] == '/';
    const bool power = before == '^' || (before == '*' && i > 1 && text[i - 2] == '*');
    if (!power && before != '-' && before != '+' && !one_over) return true;
  }
  return text.find('@') != text.npos;
}

std::string si_name(const ut_unit* unit) {
  for (const char* name : si_units) {
    const Unit si = parse_unit(name);
    if (si && unit_converter(unit, si.get())) return name;
  }
  return "";
}

/// kg.m2.s-3, what UDUNITS calls a product that has no name here.
std::string base_name(const ut_unit* unit) {
  std::array<char, 256> text{};
  const int length = ut_format(unit, text.data(), text.size() - 1, UT_ASCII | UT_DEFINITION);
  if (length <= 0) return "";
  std::string name(text.data());
  // A scaled unit begins with its factor; the unit itself comes after it.
  const std::size_t first = name.find_first_of("ACKRcdgkmrs");
  if (name.find('@') != name.npos || first == name.npos) return "";
  return name.substr(first);
}

std::optional<RecordUnit> in_si(const ut_unit* unit) {
  std::string name = si_name(unit);
  if (name.empty()) name = base_name(unit);
  if (name.empty()) return std::nullopt;
  const Unit si = parse_unit(name);
  const UnitConverter converter = si ? unit_converter(unit, si.get()) : nullptr;
  if (!converter) return std::nullopt;
  const double offset = cv_convert_double(converter.get(), 0.0);
  return RecordUnit{name, cv_convert_double(converter.get(), 1.0) - offset, offset};
}

std::string combined(const std::string& a, const std::string& b, ut_unit* (*combine)(const ut_unit*, const ut_unit*)) {
  const Unit first = parse_unit(a), second = parse_unit(b);
  if (!first || !second) return "";
  const Unit both(combine(first.get(), second.get()));
  const std::optional<RecordUnit> result = both ? in_si(both.get()) : std::nullopt;
  return result ? result->si : "";
}

}  // namespace

bool is_no_unit(std::string_view text) {
  const std::string word = lower(trimmed(text));
  return word.empty() || word == "none" || word == "-" || word == "--" || word == "unknown" || word == "unspecified" ||
         word == "(-)" || word == "[]" || word == "eu" || word == "[-]";
}

std::optional<RecordUnit> record_unit(std::string_view text) {
  const std::string_view whole = trimmed(text);
  if (whole.empty() || whole.size() > 100 || is_no_unit(whole)) return std::nullopt;
  if (whole == "%") return RecordUnit{"1", 0.01, 0};
  if (has_factor(whole)) return std::nullopt;
  const std::string spelled = in_udunits(whole);
  // The only numbers the table of spellings brings in are whole units, not factors of one.
  const Unit unit = parse_unit(spelled);
  if (!unit) return std::nullopt;
  // A torque stays one, though it has the dimension of an energy.
  if (spelled == "N.m" || spelled == "kN.m" || spelled == "N m")
    return RecordUnit{"N m", spelled[0] == 'k' ? 1e3 : 1, 0};
  return in_si(unit.get());
}

std::string unit_product(const std::string& a, const std::string& b) { return combined(a, b, ut_multiply); }
std::string unit_quotient(const std::string& a, const std::string& b) { return combined(a, b, ut_divide); }

std::string unit_suffix(const std::string& si_unit) {
  if (si_unit.empty() || si_unit == "1") return "";
  std::string above, below;
  std::string_view rest = si_unit;
  bool denominator = false;
  while (!rest.empty()) {
    std::size_t end = rest.find_first_of(" ./()");
    if (end == rest.npos) end = rest.size();
    std::string factor(rest.substr(0, end));
    const std::size_t minus = factor.find('-');
    if (minus != factor.npos) factor.erase(minus, factor.substr(minus) == "-1" ? 2 : 1);
    if (factor != "1") (denominator != (minus != std::string::npos) ? below : above) += factor;
    if (end < rest.size() && rest[end] == '/') denominator = true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  std::string suffix;
  if (!above.empty()) suffix += "_" + above;
  if (!below.empty()) suffix += "_per_" + below;
  for (char& c : suffix)
    if (static_cast<unsigned char>(c) < 0x80 && std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return suffix;
}

namespace {

/// `velocity_1_m_per_s`: the longest end that is the suffix of a unit, of SI or of those with a usual prefix.
Heading split_suffix(std::string_view text) {
  static const std::vector<std::pair<std::string, std::string>> suffixes = [] {
    std::vector<std::pair<std::string, std::string>> list;
    for (const char* unit : si_units) list.emplace_back(unit_suffix(unit), unit);
    for (const char* unit :
         {"ms", "us", "ns", "mm", "um", "kHz", "MHz", "kN", "mV", "uV", "kPa", "MPa", "GPa", "mm/s", "N m"})
      list.emplace_back(unit_suffix(unit), unit);
    // A heading that ends in _m, _s, ... has this unit; one that ends in a bare _C, _F or _1 more likely counts.
    std::erase_if(list, [](const auto& entry) {
      return entry.first.empty() || entry.first == "_C" || entry.first == "_F" || entry.first == "_T" ||
             entry.first == "_A";
    });
    std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
    return list;
  }();
  for (const auto& [suffix, unit] : suffixes)
    if (text.size() > suffix.size() && text.ends_with(suffix))
      return {std::string(text.substr(0, text.size() - suffix.size())), unit};
  return {std::string(text), ""};
}

}  // namespace

Heading parse_heading(std::string_view text) {
  const std::string_view whole = trimmed(text);
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    if (!whole.ends_with(close)) continue;
    std::size_t depth = 0;
    for (std::size_t i = whole.size(); i-- > 0;) {
      if (whole[i] == close) ++depth;
      if (whole[i] == open && --depth == 0) {
        const std::string_view unit = trimmed(whole.substr(i + 1, whole.size() - i - 2));
        const std::string_view name = trimmed(whole.substr(0, i));
        // (2) or (left) is part of the name.
        if (name.empty() || (!record_unit(unit) && !is_no_unit(unit) && open == '(')) return {std::string(whole), ""};
        return {std::string(name), std::string(unit)};
      }
    }
  }
  const std::size_t comma = whole.rfind(',');
  if (comma != whole.npos && comma > 0 && record_unit(whole.substr(comma + 1)))
    return {std::string(trimmed(whole.substr(0, comma))), std::string(trimmed(whole.substr(comma + 1)))};
  const std::size_t slash = whole.find('/');
  if (slash != whole.npos && slash > 0) {
    const std::string_view unit = trimmed(whole.substr(slash + 1));
    if (record_unit(unit)) return {std::string(trimmed(whole.substr(0, slash))), std::string(unit)};
  }
  return split_suffix(whole);
}

std::string column_name(const std::string& name, const std::string& si_unit) {
  const std::string suffix = unit_suffix(si_unit);
  return name.ends_with(suffix) ? name : name + suffix;
}

}  // namespace impulse
