#include "lib/csv/csv_table.hpp"

#include "lib/contract/errors.hpp"
#include "lib/csv/decimal.hpp"
#include "lib/csv/input_file.hpp"

#include <csv.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <set>

namespace impulse {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

/// Feeds libcsv line by line, because it knows neither line numbers nor comments.
class CsvReader {
 public:
  CsvReader() {
    if (csv_init(&parser_, CSV_STRICT | CSV_STRICT_FINI) != 0) throw std::bad_alloc();
  }
  CsvReader(const CsvReader&) = delete;
  CsvReader& operator=(const CsvReader&) = delete;
  ~CsvReader() { csv_free(&parser_); }

  CsvTable read(const std::string& path) {
    InputFile input(path);
    table_.file_ = input.name();
    std::vector<char> buffer(std::size_t{1} << 18);
    std::size_t kept = 0;
    bool first_block = true;
    while (const std::size_t count = input.read(buffer.data() + kept, buffer.size() - kept)) {
      std::string_view block(buffer.data(), kept + count);
      // A pipe may deliver the byte order mark in pieces.
      if (first_block && block.size() < 3 && std::string_view("\xEF\xBB\xBF").starts_with(block)) {
        kept = block.size();
        continue;
      }
      if (first_block && block.starts_with("\xEF\xBB\xBF")) block.remove_prefix(3);
      first_block = false;
      kept = 0;
      parse_block(block);
    }
    if (kept > 0) parse_block({buffer.data(), kept});
    if (csv_fini(&parser_, on_field, on_row, this) != 0) fail(row_line_, 0, "a quote is left open");
    if (table_.names_.empty()) fail(0, 0, "empty (expected a header line and rows)");
    if (table_.lines_.empty()) fail(0, 0, "has a header but no rows");
    return std::move(table_);
  }

 private:
  // libcsv's own name of this state, ROW_NOT_BEGUN, is not in its header. A `#` inside a quoted field is no comment.
  [[nodiscard]] bool between_rows() const { return parser_.pstate == 0; }

  void parse_block(std::string_view block) {
    while (!block.empty()) {
      if (line_begins_ && between_rows()) {
        row_line_ = line_;
        in_comment_ = block.front() == '#';
      }
      const std::size_t newline = block.find('\n');
      const std::string_view piece = block.substr(0, newline == block.npos ? newline : newline + 1);
      if (!in_comment_) parse_piece(piece);
      line_begins_ = newline != block.npos;
      if (line_begins_) {
        ++line_;
        in_comment_ = false;
      }
      block.remove_prefix(piece.size());
    }
  }

  void parse_piece(std::string_view piece) {
    const std::size_t parsed = csv_parse(&parser_, piece.data(), piece.size(), on_field, on_row, this);
    if (parsed == piece.size()) return;
    if (csv_error(&parser_) == CSV_EPARSE) fail(line_, field_ + 1, "misplaced quote");
    throw std::bad_alloc();
  }

  static void on_field(void* characters, std::size_t size, void* reader) {
    static_cast<CsvReader*>(reader)->field({static_cast<const char*>(characters), size});
  }
  static void on_row(int, void* reader) { static_cast<CsvReader*>(reader)->row(); }

  void field(std::string_view text) {
    if (in_header_) {
      table_.names_.emplace_back(trimmed(text));
    } else if (field_ < table_.texts_.size()) {
      CsvTable::Text& column = table_.texts_[field_];
      column.characters.append(trimmed(text));
      column.ends.push_back(column.characters.size());
    }
    ++field_;
  }

  void row() {
    if (in_header_) {
      require_different_names();
      table_.texts_.resize(table_.names_.size());
      in_header_ = false;
    } else {
      const std::size_t wanted = table_.names_.size();
      if (field_ != wanted)
        fail(row_line_, std::min(field_, wanted) + 1,
             fmt::format("the row has {} field{}, the header {}", field_, field_ == 1 ? "" : "s", wanted));
      table_.lines_.push_back(row_line_);
    }
    field_ = 0;
  }

  void require_different_names() const {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < table_.names_.size(); ++i)
      if (!seen.insert(table_.names_[i]).second)
        fail(row_line_, i + 1, fmt::format("two columns are called '{}'", table_.names_[i]));
  }

  [[noreturn]] void fail(std::size_t line, std::size_t column, const std::string& message) const {
    throw InputError(table_.file_, line, column, message);
  }

  csv_parser parser_{};
  CsvTable table_;
  std::size_t line_ = 1;
  std::size_t row_line_ = 1;
  std::size_t field_ = 0;
  bool line_begins_ = true;
  bool in_comment_ = false;
  bool in_header_ = true;
};

CsvTable read_csv(const std::string& path) { return CsvReader().read(path); }

std::string_view CsvTable::Text::row(std::size_t index) const {
  const std::size_t begin = index == 0 ? 0 : ends[index - 1];
  return std::string_view(characters).substr(begin, ends[index] - begin);
}

bool CsvTable::has(const std::string& name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::size_t CsvTable::field(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end())
    throw InputError(file_, 0, 0, fmt::format("no column '{}' (there are: {})", name, fmt::join(names_, ", ")));
  return static_cast<std::size_t>(found - names_.begin()) + 1;
}

std::string CsvTable::text(const std::string& name, std::size_t row) const {
  return std::string(texts_[field(name) - 1].row(row));
}

const std::vector<double>& CsvTable::column(const std::string& name) const {
  const std::size_t number = field(name);
  const auto [entry, is_new] = numbers_.try_emplace(number);
  if (!is_new) return entry->second;
  std::vector<double> values(row_count());
  for (std::size_t row = 0; row < values.size(); ++row) {
    const std::string_view field_text = texts_[number - 1].row(row);
    const Decimal decimal = leading_decimal(field_text);
    if (decimal.length != field_text.size() || decimal.length == 0 || !std::isfinite(decimal.value)) {
      numbers_.erase(entry);
      throw InputError(file_, line(row), number,
                       field_text.empty() ? fmt::format("empty field in column '{}'", name)
                       : decimal.length == field_text.size()
                           ? fmt::format("'{}' in column '{}' is too large for a number", field_text, name)
                           : fmt::format("'{}' in column '{}' is not a finite number", field_text, name));
    }
    values[row] = decimal.value;
  }
  return entry->second = std::move(values);
}

namespace {

/// Row of the first interval that differs from the usual one: the mean step would blame every interval for one gap.
std::size_t first_unusual_row(const std::vector<double>& time, double tolerance) {
  std::vector<double> intervals(time.size() - 1);
  for (std::size_t k = 0; k + 1 < time.size(); ++k) intervals[k] = time[k + 1] - time[k];
  std::vector<double> sorted = intervals;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  for (std::size_t k = 0; k < intervals.size(); ++k)
    if (!(std::abs(intervals[k] - *middle) <= tolerance * std::abs(*middle)) || intervals[k] <= 0) return k + 1;
  return time.size() - 1;
}

}  // namespace

UniformGrid uniform_time(const CsvTable& table, TimeOrigin origin) {
  constexpr double tolerance = 1e-6;
  const std::vector<double>& time = table.column("time_s");
  const std::size_t number = table.field("time_s");
  const auto fail = [&](std::size_t row, const std::string& message) {
    throw InputError(table.file(), table.line(row), number, message);
  };
  if (time.size() < 2) fail(0, "one sample only (a record needs at least two)");
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  for (std::size_t k = 0; k + 1 < time.size(); ++k) {
    if (step > 0 && std::abs(time[k + 1] - time[k] - step) <= tolerance * step) continue;
    const std::size_t row = first_unusual_row(time, tolerance);
    fail(row, fmt::format("time {} s follows {} s: the step is not uniform", time[row], time[row - 1]));
  }
  if (origin == TimeOrigin::zero && std::abs(time.front()) > tolerance * step)
    fail(0, fmt::format("time begins at {} s (it must begin at 0; ir-convert --zero-time makes it)", time.front()));
  return {step, time.size()};
}

}  // namespace impulse
