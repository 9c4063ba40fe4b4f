#include "lib/records/text_row.hpp"

#include "lib/contract/errors.hpp"
#include "lib/csv/decimal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace impulse {
namespace {

constexpr std::size_t not_wanted = std::string::npos;

bool is_blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

TextRow::TextRow(std::string file, const TextLayout& layout)
    : file_(std::move(file)),
      delimiter_(layout.delimiter),
      decimal_sign_(layout.decimal_sign),
      abscissa_field_(not_wanted) {
  std::size_t next = 1;
  for (const TextColumn& column : layout.columns) {
    if (column.role == TextColumn::Role::abscissa) abscissa_field_ = targets_.size();
    targets_.push_back(column.role == TextColumn::Role::abscissa ? 0
                       : column.role == TextColumn::Role::value  ? next++
                                                                 : not_wanted);
  }
  while (!targets_.empty() && targets_.back() == not_wanted) targets_.pop_back();
}

std::string_view TextRow::with_points(std::string_view line) {
  if (decimal_sign_ != ',') return line;
  copy_.assign(line);
  std::replace(copy_.begin(), copy_.end(), ',', '.');
  return copy_;
}

bool TextRow::begin_field(Cursor& cursor) const {
  while (cursor.at < cursor.line.size() &&
         (cursor.line[cursor.at] == ' ' || (delimiter_ == ' ' && cursor.line[cursor.at] == '\t')))
    ++cursor.at;
  return !cursor.ended && (delimiter_ != ' ' || cursor.at < cursor.line.size());
}

void TextRow::skip(Cursor& cursor) const {
  if (cursor.at < cursor.line.size() && cursor.line[cursor.at] == '"') {
    const std::size_t closing = cursor.line.find('"', cursor.at + 1);
    if (closing != cursor.line.npos) cursor.at = closing;
  }
  const std::size_t end =
      delimiter_ == ' ' ? cursor.line.find_first_of(" \t", cursor.at) : cursor.line.find(delimiter_, cursor.at);
  cursor.ended = end == cursor.line.npos;
  cursor.at = cursor.ended ? cursor.line.size() : end + 1;
}

double TextRow::number(Cursor& cursor, std::size_t line_number, std::size_t field, std::string_view& text) const {
  const bool quoted = cursor.at < cursor.line.size() && cursor.line[cursor.at] == '"';
  const std::size_t begin = cursor.at + (quoted ? 1 : 0);
  const Decimal decimal = leading_decimal(cursor.line.substr(begin));
  text = cursor.line.substr(begin, decimal.length);
  std::size_t end = begin + decimal.length;
  if (quoted && end < cursor.line.size() && cursor.line[end] == '"') ++end;
  while (end < cursor.line.size() && is_blank(cursor.line[end]) && cursor.line[end] != delimiter_) ++end;
  const bool clean = end == cursor.line.size() || cursor.line[end] == delimiter_ ||
                     (delimiter_ == ' ' && end > begin + decimal.length);
  if (decimal.length > 0 && clean && std::isfinite(decimal.value)) {
    cursor.ended = end == cursor.line.size();
    cursor.at = cursor.ended || delimiter_ == ' ' ? end : end + 1;
    return decimal.value;
  }
  Cursor rest = cursor;
  skip(rest);
  const std::size_t length = rest.at - cursor.at - (rest.ended ? 0 : 1);
  const std::string_view shown = cursor.line.substr(cursor.at, std::min<std::size_t>(length, 80));
  throw InputError(file_, line_number, field + 1,
                   shown.empty() ? "empty field" : fmt::format("'{}' is not a finite number", shown));
}

std::size_t TextRow::parse(std::string_view line, std::size_t line_number, std::span<double> values) {
  Cursor cursor{with_points(line), 0, false};
  std::string_view text;
  for (std::size_t field = 0; field < targets_.size(); ++field) {
    if (!begin_field(cursor)) return field;
    // A row that ends in a delimiter breaks off like one that ends before it.
    if (cursor.at == cursor.line.size()) return field;
    if (targets_[field] == not_wanted)
      skip(cursor);
    else
      values[targets_[field]] = number(cursor, line_number, field, text);
  }
  return targets_.size();
}

TextRow::Printed TextRow::abscissa(std::string_view line, std::size_t line_number) {
  Cursor cursor{with_points(line), 0, false};
  Printed printed{};
  for (std::size_t field = 0;; ++field) {
    if (!begin_field(cursor)) throw InputError(file_, line_number, field + 1, "the row breaks off before its time");
    if (field < abscissa_field_) {
      skip(cursor);
      continue;
    }
    printed.value = number(cursor, line_number, field, printed.text);
    return printed;
  }
}

}  // namespace impulse
