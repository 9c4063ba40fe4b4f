#include "lib/records/text_dialects.hpp"

#include "lib/contract/errors.hpp"
#include "lib/records/text_fields.hpp"
#include "lib/records/text_metadata.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace impulse {
namespace {

std::size_t line_that_begins(const TextHead& head, std::size_t from, std::string_view beginning) {
  for (std::size_t i = from; i < head.lines.size(); ++i)
    if (head.lines[i].starts_with(beginning)) return i;
  throw InputError(head.file, head.number(head.lines.size()) - 1, 0,
                   fmt::format("the heading breaks off ('{}' is missing)", beginning));
}

void add_metadata(const TextHead& head, std::size_t from, std::size_t to, TextMetadata& metadata, TextLayout& layout) {
  for (std::size_t i = from; i < to; ++i) {
    std::optional<TextMetadata::Entry> entry = metadata_entry(head.lines[i], layout.delimiter, head.number(i));
    if (!entry) continue;
    layout.metadata.emplace_back(entry->key, fmt::format("{}", fmt::join(entry->values, ", ")));
    metadata.entries.push_back(std::move(*entry));
  }
}

std::string first_value(const TextMetadata& metadata, std::string_view key) {
  const TextMetadata::Entry* entry = metadata.find({key});
  return entry && !entry->values.empty() ? entry->values.front() : "";
}

}  // namespace

std::optional<TextLayout> labview_layout(const TextHead& head) {
  if (head.lines.empty() || !head.lines.front().starts_with("LabVIEW Measurement")) return std::nullopt;
  const std::size_t first_end = line_that_begins(head, 0, labview_end_of_header);
  const std::size_t second_end = line_that_begins(head, first_end + 1, labview_end_of_header);
  const std::size_t names = line_that_begins(head, second_end + 1, labview_names);

  TextLayout layout;
  layout.format = "LabVIEW measurement (.lvm)";
  const std::string& separator = head.lines[line_that_begins(head, 0, "Separator")];
  layout.delimiter = separator.size() > 9 && separator[9] == ',' ? ',' : '\t';
  TextMetadata metadata{head.file, '.', {}};
  add_metadata(head, 0, first_end, metadata, layout);
  layout.decimal_sign = first_value(metadata, "decimalseparator") == "," ? ',' : '.';
  metadata.decimal_sign = layout.decimal_sign;
  add_metadata(head, first_end + 1, second_end, metadata, layout);
  take_timing(metadata, layout);

  const bool has_times = first_value(metadata, "xcolumns") != "No";
  bool abscissa_seen = false;
  for (const std::string& name : split_fields(head.lines[names], layout.delimiter)) {
    const bool is_time = name == labview_names;
    const bool is_abscissa = is_time && has_times && !abscissa_seen;
    abscissa_seen = abscissa_seen || is_abscissa;
    layout.columns.push_back({is_abscissa                    ? TextColumn::Role::abscissa
                              : is_time || name == "Comment" ? TextColumn::Role::ignored
                                                             : TextColumn::Role::value,
                              is_abscissa ? "time" : name, is_abscissa ? "s" : ""});
  }
  take_channels(metadata, layout);
  layout.first_line = head.number(names) + 1;
  return layout;
}

std::optional<TextLayout> lanl_layout(const TextHead& head) {
  if (head.lines.size() < 5) return std::nullopt;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < 4; ++i) rows.push_back(split_fields(head.lines[i], '\t'));
  const std::size_t width = rows[0].size();
  if (width < 3 || rows[0][0].empty() || rows[1][0].empty()) return std::nullopt;
  for (std::size_t c = 2; c < width; ++c)
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i].size() != width || rows[i][c].empty() || field_number(rows[i][c], '.').has_value() == (i == 0))
        return std::nullopt;
  const double start = *field_number(rows[1][2], '.'), step = *field_number(rows[2][2], '.');
  if (!(step > 0)) return std::nullopt;

  TextLayout layout{.format = "Kolsky bar, Los Alamos (.raw)",
                    .delimiter = '\t',
                    .first_line = 4,
                    .columns = {{}, {}},
                    .start = start,
                    .step = step,
                    .step_source = "line 3"};
  layout.notes.push_back("waveforms are in volts, as in every file of this format");
  for (std::size_t c = 2; c < width; ++c) {
    if (*field_number(rows[1][c], '.') != start || *field_number(rows[2][c], '.') != step)
      throw InputError(head.file, 3, c + 1, "the waveforms have different times");
    layout.columns.push_back({TextColumn::Role::value, rows[0][c], "V"});
  }
  for (const std::string& line : head.lines) {
    const std::vector<std::string> fields = split_fields(line, '\t');
    if (fields.size() > 1 && !fields[0].empty()) layout.metadata.emplace_back(fields[0], fields[1]);
  }
  return layout;
}

}  // namespace impulse
