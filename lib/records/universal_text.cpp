#include "lib/records/universal_text.hpp"

#include "lib/csv/decimal.hpp"
#include "lib/records/text_encoding.hpp"
#include "lib/records/text_fields.hpp"

#include <algorithm>
#include <string>

namespace impulse {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Length of an exponent without a letter, sign and three digits, at the beginning of a text; 0 if there is none. Two
/// of such numbers side by side begin with a mantissa, which has a point.
std::size_t bare_exponent(std::string_view text) {
  if (text.size() < 4 || (text[0] != '+' && text[0] != '-')) return 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (!is_digit(text[i])) return 0;
  return text.size() == 4 || (!is_digit(text[4]) && text[4] != '.') ? 4 : 0;
}

}  // namespace

bool UniversalCursor::next_line(std::string_view& line) {
  if (at_ >= bytes_.size()) return false;
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  line = bytes_.substr(at_, end - at_);
  at_ = std::min(end + 1, bytes_.size());
  while (line.ends_with('\r')) line.remove_suffix(1);
  ++line_;
  return true;
}

bool is_dataset_mark(std::string_view line) {
  // A binary dataset may have lost the line end before it, but not its blanks.
  while (line.ends_with('\r') || line.ends_with('\n')) line.remove_suffix(1);
  return trimmed_field(line) == "-1";
}

std::optional<double> take_number(std::string_view& line) {
  while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
  const Decimal decimal = leading_decimal(line);
  if (decimal.length == 0) return std::nullopt;
  const std::string_view text = line.substr(0, decimal.length), after = line.substr(decimal.length);
  const bool has_letter = text.find_first_of("eE") != text.npos;
  std::size_t exponent = 0;
  bool letter = false;
  if (!has_letter && after.size() > 1 && (after[0] == 'D' || after[0] == 'd')) {
    letter = true;
    exponent = 1 + (after[1] == '+' || after[1] == '-' ? 1 : 0);
    while (exponent < after.size() && is_digit(after[exponent])) ++exponent;
  } else if (!has_letter && text.find('.') != text.npos) {
    exponent = bare_exponent(after);
  }
  double value = decimal.value;
  if (exponent > 0) {
    const std::string spelled =
        std::string(text) + "E" + std::string(after.substr(letter ? 1 : 0, exponent - (letter ? 1 : 0)));
    const Decimal whole = leading_decimal(spelled);
    if (whole.length == spelled.size()) value = whole.value;
  }
  line.remove_prefix(decimal.length + exponent);
  return value;
}

std::string_view columns_of(std::string_view line, std::size_t begin, std::size_t length) {
  const bool letters = text_encoding(line) == "UTF-8";
  const auto byte_of = [&](std::size_t column) {
    if (!letters) return std::min(column, line.size());
    std::size_t at = 0;
    for (; at < line.size(); ++at) {
      const bool starts = (static_cast<unsigned char>(line[at]) & 0xC0) != 0x80;
      if (starts && column-- == 0) break;
    }
    return at;
  };
  const std::size_t first = byte_of(begin), last = byte_of(begin + length);
  return trimmed_field(line.substr(first, last - first));
}

}  // namespace impulse
