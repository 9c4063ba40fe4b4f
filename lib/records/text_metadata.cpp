#include "lib/records/text_metadata.hpp"

#include "lib/contract/errors.hpp"
#include "lib/csv/decimal.hpp"
#include "lib/records/record_unit.hpp"
#include "lib/records/text_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace impulse {
namespace {

/// 5, `5 kHz`, `1 MS/s`: the number in SI if its unit, or else `unit`, is known; empty if it isn't a number.
std::optional<double> number_in(const std::string& text, const std::string& unit, const std::string& si,
                                char decimal_sign) {
  std::string value = text;
  if (decimal_sign == ',') std::replace(value.begin(), value.end(), ',', '.');
  const std::string_view whole = trimmed_field(value);
  const Decimal number = leading_decimal(whole);
  if (number.length == 0 || !std::isfinite(number.value)) return std::nullopt;
  std::string spelled(trimmed_field(whole.substr(number.length)));
  if (spelled.empty()) spelled = unit;
  // Samples per second are S/s, Sa/s or sps, with the prefix of hertz.
  for (const char* samples : {"Samples/s", "Sa/s", "S/s", "sps", "SPS"}) {
    const std::size_t at = spelled.find(samples);
    if (at != spelled.npos) spelled = spelled.substr(0, at) + "Hz";
  }
  if (spelled == "S") spelled = "s";
  if (is_no_unit(spelled)) return number.value;
  const std::optional<RecordUnit> known = record_unit(spelled);
  if (!known || known->si != si) return std::nullopt;
  const double inverse = std::nearbyint(1 / known->factor);
  return std::abs(inverse * known->factor - 1) < 1e-12 ? number.value / inverse : number.value * known->factor;
}

/// The one number that all values of an entry are.
std::optional<double> common_number(const TextMetadata& metadata, const TextMetadata::Entry* entry,
                                    const std::string& unit, const std::string& si) {
  if (!entry) return std::nullopt;
  const Heading heading = parse_heading(entry->key);
  std::optional<double> common;
  for (const std::string& text : entry->values) {
    if (text.empty()) continue;
    const std::optional<double> value =
        number_in(text, heading.unit.empty() ? unit : heading.unit, si, metadata.decimal_sign);
    if (!value) break;
    if (common && *common != *value)
      throw InputError(metadata.file, entry->line, 0,
                       fmt::format("'{}' differs between the channels ({} and {}): convert them one by one", entry->key,
                                   *common, *value));
    common = value;
  }
  return common;
}

}  // namespace

const TextMetadata::Entry* TextMetadata::find(std::initializer_list<std::string_view> keys) const {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.is(keys); });
  return found == entries.end() ? nullptr : &*found;
}

const TextMetadata::Entry* TextMetadata::find_if(bool (*is_key)(std::string_view)) const {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const Entry& entry) { return is_key(plain_key(parse_heading(entry.key).name)); });
  return found == entries.end() ? nullptr : &*found;
}

bool TextMetadata::Entry::is(std::initializer_list<std::string_view> keys) const {
  const std::string plain = plain_key(parse_heading(key).name);
  return std::find(keys.begin(), keys.end(), plain) != keys.end();
}

std::optional<TextMetadata::Entry> metadata_entry(std::string_view line, char delimiter, std::size_t number) {
  while (!line.empty() && (line.front() == '#' || line.front() == '%')) line.remove_prefix(1);
  std::vector<std::string> fields =
      delimiter == ' ' ? std::vector{std::string(trimmed_field(line))} : split_fields(line, delimiter);
  while (!fields.empty() && fields.front().empty()) fields.erase(fields.begin());
  if (fields.empty()) return std::nullopt;
  std::string key = fields.front();
  fields.erase(fields.begin());
  if (fields.empty()) {
    const std::size_t mark = key.find_first_of(":=");
    if (mark == key.npos || mark == 0) return std::nullopt;
    fields.emplace_back(trimmed_field(std::string_view(key).substr(mark + 1)));
    key = std::string(trimmed_field(std::string_view(key).substr(0, mark)));
  }
  while (key.ends_with(':') || key.ends_with('=') || key.ends_with(' ')) key.pop_back();
  if (key.empty() || field_number(key, '.')) return std::nullopt;
  return TextMetadata::Entry{key, fields, number};
}

std::optional<std::string> time_unit(const TextMetadata& metadata) {
  const TextMetadata::Entry* entry = metadata.find({"horizontalunits", "hunit", "horzunits", "xunit", "xunits"});
  if (!entry || entry->values.empty()) return std::nullopt;
  return entry->values.front() == "S" ? "s" : entry->values.front();
}

bool is_interval_key(std::string_view key) {
  static constexpr std::array keys{
      "sampleinterval", "samplinginterval", "interval",  "deltax",         "deltat",   "dt",
      "timeincrement",  "xincrement",       "increment", "hresolution",    "timestep", "sampleperiod",
      "samplingperiod", "tinterval",        "stepsize",  "abtastintervall"};
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

bool is_rate_key(std::string_view key) {
  static constexpr std::array keys{"samplerate", "samplingrate",    "samplefrequency", "samplingfrequency",
                                   "fs",         "acquisitionrate", "scanrate",        "abtastrate"};
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

void take_timing(const TextMetadata& metadata, TextLayout& layout) {
  const TextMetadata::Entry* interval = metadata.find_if(is_interval_key);
  const TextMetadata::Entry* rate = metadata.find_if(is_rate_key);
  const std::string unit = time_unit(metadata).value_or("s");
  layout.step = common_number(metadata, interval, unit, "s");
  const TextMetadata::Entry* source = interval;
  if (!layout.step && rate) {
    const std::optional<double> hertz = common_number(metadata, rate, "Hz", "Hz");
    if (hertz) layout.step = 1 / *hertz;
    source = rate;
  }
  if (layout.step && !(*layout.step > 0 && std::isfinite(*layout.step)))
    throw InputError(metadata.file, source->line, 0, fmt::format("'{}' must be positive", source->key));
  if (layout.step) layout.step_source = fmt::format("'{}' in line {}", source->key, source->line);
  layout.start = common_number(metadata, metadata.find({"x0", "hoffset", "xorigin", "xoffset", "t0"}), unit, "s");
}

void take_channels(const TextMetadata& metadata, TextLayout& layout) {
  std::vector<TextColumn*> all, values;
  for (TextColumn& column : layout.columns) {
    if (column.role == TextColumn::Role::ignored) continue;
    all.push_back(&column);
    if (column.role == TextColumn::Role::value) values.push_back(&column);
  }
  const auto take = [&](std::initializer_list<std::string_view> keys, std::string TextColumn::*member) {
    // Beside the rows every channel has its own line.
    std::vector<std::string> found;
    for (const TextMetadata::Entry& entry : metadata.entries)
      if (entry.is(keys)) found.insert(found.end(), entry.values.begin(), entry.values.end());
    const std::size_t count = found.size();
    // A line for the channels may or may not count the time among them.
    const std::vector<TextColumn*>& targets = count == values.size() ? values : all;
    if (count != targets.size()) return;
    for (std::size_t i = 0; i < count; ++i)
      if ((targets[i]->*member).empty()) targets[i]->*member = found[i];
  };
  take({"tracename", "signal", "signals", "channelnames", "channelname", "source", "name", "names"}, &TextColumn::name);
  take({"vunit", "vertunits", "verticalunits", "yunitlabel", "units", "unit", "yunit", "yunits", "channelunits"},
       &TextColumn::unit);
}

}  // namespace impulse
