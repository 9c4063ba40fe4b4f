#include "lib/records/text_shape.hpp"

#include "lib/contract/errors.hpp"
#include "lib/records/text_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace impulse {
namespace {

bool is_empty_line(const std::string& line) { return line.find_first_not_of(" \t,;|") == line.npos; }
bool is_comment(const std::string& line) { return line.starts_with('#') || line.starts_with('%'); }

std::vector<std::size_t> number_fields(const std::vector<std::string>& fields, char decimal_sign) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (field_number(fields[i], decimal_sign)) numbers.push_back(i);
  return numbers;
}

/// Most rows at the end of what is known of the text decide; the very last may be cut off.
constexpr std::size_t deciding_lines = 20;

struct Candidate {
  TextShape shape;
  double share;  ///< of the deciding lines that have it

  [[nodiscard]] double worth() const {
    return (static_cast<double>(shape.numbers.size()) - static_cast<double>(shape.texts)) * share;
  }
};

std::optional<Candidate> shape_with(const TextHead& head, char delimiter, char decimal_sign) {
  std::map<std::vector<std::size_t>, std::size_t> votes;
  std::map<std::vector<std::size_t>, std::size_t> texts;
  std::size_t seen = 0;
  for (std::size_t i = head.lines.size(); i-- > 0 && seen < deciding_lines;) {
    if (is_empty_line(head.lines[i]) || is_comment(head.lines[i])) continue;
    const std::vector<std::string> fields = split_fields(head.lines[i], delimiter);
    const std::vector<std::size_t> numbers = number_fields(fields, decimal_sign);
    ++seen;
    if (numbers.empty()) continue;
    ++votes[numbers];
    // The lines run upwards, and the rows stand below the heading: the first to come counts.
    const auto filled = std::count_if(fields.begin(), fields.end(), [](const std::string& f) { return !f.empty(); });
    texts.emplace(numbers, static_cast<std::size_t>(filled) - numbers.size());
  }
  if (votes.empty()) return std::nullopt;
  // Of equal votes the one with more columns: a cut-off last line must not outvote the only other row.
  const auto most = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) {
    return a.second != b.second ? a.second < b.second : a.first.size() < b.first.size();
  });
  return Candidate{{delimiter, decimal_sign, 0, most->first, texts[most->first]},
                   static_cast<double>(most->second) / static_cast<double>(seen)};
}

bool is_row(const TextShape& shape, const std::string& line) {
  const std::vector<std::string> fields = split_fields(line, shape.delimiter);
  // Where rows begin with an empty field, a key in it makes numbers metadata: `BlockSize,1000,1000`. Metadata beside
  // the rows takes two fields or more.
  if (shape.numbers.front() == 1 && shape.texts == 0 && !fields.empty() && !fields.front().empty()) return false;
  return std::all_of(shape.numbers.begin(), shape.numbers.end(),
                     [&](std::size_t i) { return i < fields.size() && field_number(fields[i], shape.decimal_sign); });
}

bool has_some_number(const TextShape& shape, const std::string& line) {
  const std::vector<std::string> fields = split_fields(line, shape.delimiter);
  return std::any_of(shape.numbers.begin(), shape.numbers.end(),
                     [&](std::size_t i) { return i < fields.size() && field_number(fields[i], shape.decimal_sign); });
}

std::size_t first_row(const TextHead& head, const TextShape& shape) {
  std::size_t first = head.lines.size();
  bool found = false;
  for (std::size_t i = head.lines.size(); i-- > 0;) {
    const std::string& line = head.lines[i];
    if (is_empty_line(line) || is_comment(line)) continue;
    if (is_row(shape, line)) {
      first = i;
      found = true;
    } else if (found) {
      break;
    }
  }
  return first;
}

/// A line that is no row, though rows stand before and after it, is an error in the data and not the end of a heading.
void require_no_rows_before(const TextHead& head, const TextShape& shape) {
  std::size_t rows = 0;
  for (std::size_t i = 0; i < shape.first; ++i) {
    const std::string& line = head.lines[i];
    if (is_empty_line(line) || is_comment(line)) continue;
    if (is_row(shape, line)) {
      ++rows;
    } else if (rows > 0) {
      if (rows > 1 || (shape.numbers.size() > 1 && has_some_number(shape, line)))
        throw InputError(head.file, i + 1, 0,
                         fmt::format("'{}' is no row of {} numbers, but rows stand before and after it",
                                     line.substr(0, 80), shape.numbers.size()));
      rows = 0;
    }
  }
}

}  // namespace

std::string delimiter_name(char delimiter) {
  if (delimiter == '\t') return "tab";
  return delimiter == ' ' ? "blanks" : std::string(1, delimiter);
}

TextShape text_shape(const TextHead& head, const TextOptions& options) {
  std::optional<Candidate> best;
  std::string delimiters = "\t;,| ";
  if (options.delimiter) delimiters = *options.delimiter;
  for (const char delimiter : delimiters)
    for (const char sign : {'.', ','}) {
      if ((options.decimal_sign && *options.decimal_sign != sign) || sign == delimiter) continue;
      const std::optional<Candidate> candidate = shape_with(head, delimiter, sign);
      if (candidate && (!best || candidate->worth() > best->worth())) best = candidate;
    }
  if (!best)
    throw InputError(head.file, head.lines.size(), 0,
                     fmt::format("no rows of numbers in the first {} lines (is it a record?)", head.lines.size()));
  best->shape.first = first_row(head, best->shape);
  require_no_rows_before(head, best->shape);
  return best->shape;
}

}  // namespace impulse
