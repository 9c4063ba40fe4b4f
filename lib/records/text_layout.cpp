#include "lib/records/text_layout.hpp"

#include "lib/contract/errors.hpp"
#include "lib/records/record_unit.hpp"
#include "lib/records/text_dialects.hpp"
#include "lib/records/text_fields.hpp"
#include "lib/records/text_metadata.hpp"
#include "lib/records/text_shape.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace impulse {
namespace {

using Role = TextColumn::Role;

bool is_of_time(const std::string& unit) {
  const std::optional<RecordUnit> known = record_unit(unit);
  return known && known->si == "s";
}

bool is_of_frequency(const std::string& unit) {
  const std::optional<RecordUnit> known = record_unit(unit);
  return known && known->si == "Hz";
}

std::string without_brackets(const std::string& text) {
  const bool bracketed =
      text.size() > 1 && ((text.front() == '[' && text.back() == ']') || (text.front() == '(' && text.back() == ')'));
  return bracketed ? text.substr(1, text.size() - 2) : text;
}

/// A heading split at blanks falls apart: `Time (s)` is one of its fields.
std::vector<std::string> heading_fields(std::string_view line, char delimiter) {
  while (!line.empty() && (line.front() == '#' || line.front() == '%')) line.remove_prefix(1);
  std::vector<std::string> fields = split_fields(line, delimiter);
  if (delimiter != ' ') return fields;
  std::vector<std::string> joined;
  for (const std::string& field : fields) {
    if (!joined.empty() && (field.starts_with('(') || field.starts_with('[')))
      joined.back() += " " + field;
    else
      joined.push_back(field);
  }
  return joined;
}

class LayoutFinder {
 public:
  LayoutFinder(const TextHead& head, const TextOptions& options)
      : head_(head),
        options_(options),
        shape_(text_shape(head, options)),
        metadata_{head.file, shape_.decimal_sign, {}} {
    layout_.delimiter = shape_.delimiter;
    layout_.decimal_sign = shape_.decimal_sign;
    layout_.first_line = shape_.first + 1;
    layout_.columns.resize(shape_.numbers.back() + 1);
    for (const std::size_t i : shape_.numbers) layout_.columns[i].role = Role::value;
  }

  TextLayout find() {
    const std::size_t heading_begin = take_headings();
    take_metadata(heading_begin);
    take_timing(metadata_, layout_);
    take_channels(metadata_, layout_);
    choose_abscissa();
    take_channels(metadata_, layout_);
    for (TextColumn& column : layout_.columns)
      if (column.role == Role::abscissa && column.unit.empty()) column.unit = time_unit(metadata_).value_or("");
    name_the_nameless();
    name_format();
    return std::move(layout_);
  }

 private:
  [[nodiscard]] std::size_t line_above(std::size_t line) const {
    while (line-- > 0)
      if (head_.lines[line].find_first_not_of(" \t,;|") != std::string::npos) return line;
    return std::string::npos;
  }

  /// The fields above the columns of numbers; empty unless there is one for each of them and none is a number.
  [[nodiscard]] std::vector<std::string> fields_above(std::size_t line) const {
    if (line == std::string::npos) return {};
    const std::vector<std::string> fields = heading_fields(head_.lines[line], shape_.delimiter);
    // A key where rows have an empty field: metadata, as in text_shape.
    if (shape_.numbers.front() == 1 && shape_.texts == 0 && !fields.empty() && !fields.front().empty()) return {};
    std::vector<std::string> above;
    for (const std::size_t i : shape_.numbers) {
      if (i >= fields.size() || fields[i].empty() || field_number(fields[i], shape_.decimal_sign)) return {};
      above.push_back(fields[i]);
    }
    return above;
  }

  static bool are_units(const std::vector<std::string>& fields) {
    return !fields.empty() && std::all_of(fields.begin(), fields.end(), [](const std::string& field) {
      return record_unit(without_brackets(field)) || is_no_unit(field) || without_brackets(field) != field;
    });
  }

  /// Names and units above the rows. Returns the index of the first line that is taken.
  std::size_t take_headings() {
    const std::size_t near = line_above(shape_.first);
    std::vector<std::string> names = fields_above(near), units;
    if (names.empty()) return shape_.first;
    std::size_t begin = near;
    const std::size_t far = line_above(near);
    const std::vector<std::string> above = fields_above(far);
    if (are_units(names) && !above.empty()) {
      units = names;
      names = above;
      begin = far;
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      TextColumn& column = layout_.columns[shape_.numbers[i]];
      const Heading heading = parse_heading(names[i]);
      column.name = heading.name;
      column.unit = units.empty() ? heading.unit : without_brackets(units[i]);
    }
    return begin;
  }

  void add(TextMetadata::Entry entry) {
    layout_.metadata.emplace_back(entry.key, fmt::format("{}", fmt::join(entry.values, ", ")));
    metadata_.entries.push_back(std::move(entry));
  }

  void take_metadata(std::size_t heading_begin) {
    for (std::size_t i = 0; i < heading_begin; ++i)
      if (std::optional<TextMetadata::Entry> entry = metadata_entry(head_.lines[i], shape_.delimiter, i + 1))
        add(std::move(*entry));
    for (std::size_t i = shape_.first; i < head_.lines.size(); ++i) take_metadata_beside(i);
  }

  /// Of each group of fields that aren't numbers in every row, the first two that are filled: key and value.
  void take_metadata_beside(std::size_t line) {
    const std::vector<std::string> fields = split_fields(head_.lines[line], shape_.delimiter);
    const auto is_beside = [&](std::size_t c) { return layout_.columns[c].role == Role::ignored; };
    for (std::size_t c = 0; c < layout_.columns.size(); ++c) {
      if (!is_beside(c)) continue;
      std::vector<std::string> filled;
      for (; c < layout_.columns.size() && is_beside(c); ++c)
        if (c < fields.size() && !fields[c].empty()) filled.push_back(fields[c]);
      if (filled.size() < 2) continue;
      add({filled[0], {filled[1]}, line + 1});
      beside_ = true;
    }
  }

  void choose_abscissa() {
    if (options_.abscissa_column) {
      if (*options_.abscissa_column != "none") layout_.columns[asked_column()].role = Role::abscissa;
      return;
    }
    for (const bool by_unit : {false, true})
      for (const std::size_t i : shape_.numbers) {
        const TextColumn& column = layout_.columns[i];
        if (!(by_unit ? is_of_time(column.unit) || is_of_frequency(column.unit) : is_called_time(column.name)))
          continue;
        layout_.columns[i].role = Role::abscissa;
        return;
      }
    const bool named = std::any_of(layout_.columns.begin(), layout_.columns.end(),
                                   [](const TextColumn& c) { return !c.name.empty(); });
    if (beside_) {
      choose_abscissa_of_pairs();
    } else if (!named && shape_.numbers.size() > 1 && !layout_.step) {
      layout_.columns[shape_.numbers.front()].role = Role::abscissa;
      layout_.notes.push_back(fmt::format("column {} has no name: taken as time (--time-column says otherwise)",
                                          shape_.numbers.front() + 1));
    }
  }

  /// With metadata beside them, each group of columns is a time and its channels; only one time is needed.
  void choose_abscissa_of_pairs() {
    bool first = true;
    for (std::size_t c = 0; c + 1 < layout_.columns.size(); ++c) {
      const bool begins =
          layout_.columns[c].role == Role::value && (c == 0 || layout_.columns[c - 1].role == Role::ignored);
      if (!begins || layout_.columns[c + 1].role != Role::value) continue;
      layout_.columns[c].role = first ? Role::abscissa : Role::ignored;
      first = false;
      ++c;
    }
  }

  [[nodiscard]] std::size_t asked_column() const {
    const std::string& wanted = *options_.abscissa_column;
    for (const std::size_t i : shape_.numbers)
      if (layout_.columns[i].name == wanted || std::to_string(i + 1) == wanted) return i;
    std::vector<std::string> names;
    for (const std::size_t i : shape_.numbers)
      names.push_back(layout_.columns[i].name.empty() ? std::to_string(i + 1) : layout_.columns[i].name);
    throw InputError(head_.file, 0, 0,
                     fmt::format("no column of numbers '{}' (there are: {})", wanted, fmt::join(names, ", ")));
  }

  static bool is_called_time(const std::string& name) {
    const std::string key = plain_key(name);
    return key == "t" || key == "sec" || key == "seconds" || key == "xvalue" || key == "frequency" || key == "freq" ||
           key == "relativetime" || key == "elapsedtime" || key.starts_with("time") || key.starts_with("zeit") ||
           key == "temps";
  }

  void name_the_nameless() {
    std::size_t number = 0;
    for (TextColumn& column : layout_.columns) {
      if (column.role == Role::ignored) continue;
      if (column.role == Role::value) ++number;
      if (column.name.empty()) column.name = column.role == Role::abscissa ? "time" : fmt::format("channel_{}", number);
    }
  }

  void name_format() {
    const bool has_abscissa = std::any_of(layout_.columns.begin(), layout_.columns.end(),
                                          [](const TextColumn& c) { return c.role == Role::abscissa; });
    const auto said = [&](std::string_view word) {
      return std::any_of(head_.lines.begin(),
                         head_.lines.begin() + static_cast<std::ptrdiff_t>(std::min(shape_.first, head_.lines.size())),
                         [&](const std::string& line) { return plain_key(line).find(word) != std::string::npos; });
    };
    if (metadata_.find({"recordlength"}) && metadata_.find({"sampleinterval"}))
      layout_.format = beside_ ? "Tektronix oscilloscope CSV, metadata beside the data"
                               : "Tektronix oscilloscope CSV, metadata above the data";
    else if (said("dewesoft") || metadata_.find({"storetype"}) ||
             (metadata_.find({"numberofchannels"}) && metadata_.find({"samplerate"})))
      layout_.format = "Dewesoft text";
    else if (layout_.step && !has_abscissa)
      layout_.format = "transient-recorder text";
    else
      layout_.format = "delimited text";
    layout_.format +=
        fmt::format(" ({}{})", delimiter_name(shape_.delimiter), shape_.decimal_sign == ',' ? ", decimal comma" : "");
  }

  const TextHead& head_;
  const TextOptions& options_;
  TextShape shape_;
  TextMetadata metadata_;
  TextLayout layout_;
  bool beside_ = false;
};

[[noreturn]] void refuse_dialect(const TextHead& head, const std::string& wanted) {
  throw InputError(head.file, 1, 0, fmt::format("this is not {}", wanted));
}

}  // namespace

TextLayout text_layout(const TextHead& head, TextDialect dialect, const TextOptions& options) {
  if (dialect == TextDialect::any || dialect == TextDialect::labview) {
    if (std::optional<TextLayout> layout = labview_layout(head)) return *layout;
    if (dialect == TextDialect::labview) refuse_dialect(head, "a LabVIEW measurement (.lvm)");
  }
  if (dialect == TextDialect::any || dialect == TextDialect::lanl) {
    if (std::optional<TextLayout> layout = lanl_layout(head)) return *layout;
    if (dialect == TextDialect::lanl) refuse_dialect(head, "a Kolsky-bar file of Los Alamos (.raw)");
  }
  TextLayout layout = LayoutFinder(head, options).find();
  if (dialect == TextDialect::tektronix && !layout.format.starts_with("Tektronix"))
    refuse_dialect(head, "a Tektronix oscilloscope CSV (no 'Record Length' and 'Sample Interval')");
  if (dialect == TextDialect::dewesoft && !layout.format.starts_with("Dewesoft"))
    refuse_dialect(head, "a Dewesoft text");
  if (dialect == TextDialect::transient && !layout.step)
    refuse_dialect(head, "a transient recorder's text (no sample rate or interval in its heading)");
  return layout;
}

}  // namespace impulse
