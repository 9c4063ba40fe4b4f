#include "lib/records/text_fields.hpp"

#include "lib/csv/decimal.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace impulse {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// End of the field that begins at `begin`: the next delimiter outside quotes.
std::size_t field_end(std::string_view line, std::size_t begin, char delimiter) {
  std::size_t first = begin;
  while (first < line.size() && line[first] == ' ') ++first;
  if (first < line.size() && line[first] == '"') {
    const std::size_t closing = line.find('"', first + 1);
    if (closing != line.npos) begin = closing;
  }
  if (delimiter != ' ') return std::min(line.find(delimiter, begin), line.size());
  return std::min(line.find_first_of(" \t", begin), line.size());
}

}  // namespace

std::string_view trimmed_field(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') return text.substr(1, text.size() - 2);
  return text;
}

std::vector<std::string> split_fields(std::string_view line, char delimiter) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  while (begin <= line.size()) {
    if (delimiter == ' ')
      while (begin < line.size() && is_blank(line[begin])) ++begin;
    const std::size_t end = field_end(line, begin, delimiter);
    fields.emplace_back(trimmed_field(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

std::optional<double> field_number(std::string_view field, char decimal_sign) {
  std::string text(trimmed_field(field));
  if (decimal_sign == ',') {
    if (text.find('.') != text.npos) return std::nullopt;
    std::replace(text.begin(), text.end(), ',', '.');
  }
  const Decimal decimal = leading_decimal(text);
  if (decimal.length == 0 || decimal.length != text.size() || !std::isfinite(decimal.value)) return std::nullopt;
  return decimal.value;
}

std::string plain_key(std::string_view key) {
  std::string plain;
  for (const char c : key)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return plain;
}

}  // namespace impulse
