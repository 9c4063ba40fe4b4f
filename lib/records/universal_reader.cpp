#include "lib/records/universal_file.hpp"

#include "lib/contract/errors.hpp"
#include "lib/records/universal_function.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace impulse {
namespace {

/// A float or double at `bytes`, in whichever order.
double number_at(const char* bytes, std::size_t size, ByteOrder order) {
  std::array<unsigned char, 8> raw{};
  std::memcpy(raw.data(), bytes, size);
  if (order == ByteOrder::big) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
  std::uint64_t bits = 0;
  for (std::size_t i = size; i-- > 0;) bits = bits << 8 | raw[i];
  return size == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                   : std::bit_cast<double>(bits);
}

/// Measured numbers lie between these, or are zero; those of swapped bytes mostly don't.
std::size_t count_implausible(std::string_view values, std::size_t size, ByteOrder order) {
  std::size_t count = 0;
  for (std::size_t at = 0; at + size <= values.size(); at += size) {
    const double x = std::abs(number_at(values.data() + at, size, order));
    count += x == 0 || (x > 1e-20 && x < 1e20) ? 0 : 1;
  }
  return count;
}

class UniversalReader {
 public:
  UniversalReader(const RecordFile& file, const BinaryOptions& options)
      : name_(file.name()),
        options_(options),
        bytes_(file.head(std::numeric_limits<std::size_t>::max())),
        cursor_(bytes_) {}

  std::vector<Record> read() {
    std::string_view line;
    while (cursor_.next_line(line)) {
      if (line.find_first_not_of(" \t") == line.npos) continue;
      if (!is_dataset_mark(line))
        fail(fmt::format("expected the -1 that begins a dataset, found '{}'", line.substr(0, 40)));
      // Some writers give every dataset a mark of its own at both ends, some one between two.
      bool has_heading = true;
      while (has_heading && is_dataset_mark(line)) has_heading = cursor_.next_line(line);
      if (has_heading) read_dataset(line);
    }
    if (records_.empty()) fail("no dataset 58 in it");
    return std::move(records_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(name_, cursor_.line(), 0, message); }
  [[noreturn]] void fail_at_byte(std::size_t byte, const std::string& message) const {
    throw InputError(name_, 0, 0, fmt::format("byte {}: {}", byte + 1, message));
  }

  void read_dataset(std::string_view heading) {
    std::string_view rest = heading;
    const std::optional<double> number = take_number(rest);
    if (!number) fail(fmt::format("'{}' is no dataset", heading.substr(0, 40)));
    const bool binary = !rest.empty() && (rest.front() == 'b' || rest.front() == 'B');
    if (*number == 164) return read_units();
    if (*number != 58) return skip_dataset();
    if (binary) rest.remove_prefix(1);
    read_function(binary ? rest : std::string_view(), binary);
  }

  void skip_dataset() {
    std::string_view line;
    while (cursor_.next_line(line))
      if (is_dataset_mark(line)) return;
  }

  void read_units() {
    std::string_view line;
    if (!cursor_.next_line(line)) fail("dataset 164 breaks off");
    std::vector<double> numbers;
    while (cursor_.next_line(line) && !is_dataset_mark(line))
      while (const std::optional<double> number = take_number(line)) numbers.push_back(*number);
    if (numbers.size() < 3 || !(numbers[0] > 0 && numbers[1] > 0 && numbers[2] > 0))
      fail("dataset 164 has no three positive factors");
    units_ = UniversalUnits{numbers[0], numbers[1], numbers[2]};
  }

  void read_function(std::string_view binary_fields, bool binary) {
    const UniversalFunction function = read_universal_heading(cursor_, name_);
    std::vector<double> values = binary ? binary_values(function, binary_fields) : text_values(function);
    if (values.size() < function.values_per_sample()) fail("a dataset 58 without a whole sample");
    add(function, values, binary);
  }

  void add(const UniversalFunction& function, const std::vector<double>& values, bool binary) {
    const UniversalChannel described = universal_channel(function, units_);
    const std::size_t width = function.values_per_sample(), count = values.size() / width;
    Abscissa abscissa = universal_abscissa(function);
    abscissa.size = count;
    if (function.is_even && !(std::isfinite(abscissa.start) && abscissa.step > 0 && std::isfinite(abscissa.step)))
      fail(fmt::format("the step of the even abscissa is {} {}", abscissa.step, abscissa.unit));
    std::vector<double> places;
    const double factor = abscissa_factor(function);
    Channel channel{described.info, {}, {}};
    for (std::size_t k = 0; k < count; ++k) {
      std::size_t column = k * width;
      if (!function.is_even) places.push_back(values[column++] * factor);
      channel.values.push_back(values[column] / described.divisor);
      if (function.is_complex) channel.imaginary.push_back(values[column + 1] / described.divisor);
    }
    Record& record = record_with(abscissa, places, binary);
    if (described.info.unit.empty())
      record.notes.push_back(fmt::format("channel '{}'{} has no unit: --unit says it", described.info.name,
                                         described.info.quantity.empty() ? "" : " (" + described.info.quantity + ")"));
    for (std::size_t i = 0; i < function.id.size(); ++i)
      if (!function.id[i].empty())
        record.metadata.emplace_back(fmt::format("{} id {}", described.info.name, i + 1), function.id[i]);
    record.channels.push_back(std::move(channel));
    for (std::string& note : pending_notes_) record.notes.push_back(std::move(note));
    pending_notes_.clear();
  }

  Record& record_with(const Abscissa& abscissa, const std::vector<double>& places, bool binary) {
    for (Record& record : records_)
      if (record.abscissa.unit == abscissa.unit && record.abscissa.start == abscissa.start &&
          record.abscissa.step == abscissa.step && record.abscissa.size == abscissa.size &&
          record.abscissa_values == places)
        return record;
    Record record;
    record.format = fmt::format("universal file, dataset 58{}", binary ? "b" : "");
    record.abscissa = abscissa;
    record.abscissa_values = places;
    records_.push_back(std::move(record));
    return records_.back();
  }

  std::vector<double> text_values(const UniversalFunction& function) {
    const std::size_t wanted = function.count * function.values_per_sample(), first = cursor_.line() + 1;
    // No number takes less than two bytes, so that a heading cannot ask for more memory than the file is worth.
    std::vector<double> values;
    values.reserve(std::min(wanted, cursor_.rest().size() / 2 + 1));
    std::string_view line;
    bool ended = false;
    while (cursor_.next_line(line)) {
      if (is_dataset_mark(line)) {
        ended = true;
        break;
      }
      while (const std::optional<double> number = take_number(line)) {
        if (!std::isfinite(*number)) fail("a number is too large");
        values.push_back(*number);
      }
      if (!line.empty()) fail(fmt::format("'{}' is no number", line.substr(0, 40)));
      if (values.size() > wanted + 6) fail(fmt::format("more than the {} values that the heading says", wanted));
    }
    if (values.size() < wanted) {
      if (options_.incomplete == Incomplete::refuse)
        fail(fmt::format("the dataset breaks off after {} of {} values (from line {} on; --incomplete takes them)",
                         values.size(), wanted, first));
      pending_notes_.push_back(fmt::format("the dataset breaks off after {} of {} values", values.size(), wanted));
    } else if (!ended) {
      pending_notes_.push_back("the last dataset has no -1 at its end");
    }
    if (values.size() > wanted)
      pending_notes_.push_back(
          fmt::format("{} values too many at the end of the last line: left out", values.size() - wanted));
    values.resize(std::min(values.size(), wanted));
    return values;
  }

  /// Whether a dataset's end, or the file's, is behind `length` bytes from `begin` on.
  [[nodiscard]] bool ends_behind(std::size_t begin, std::size_t length) const {
    const std::string_view rest = cursor_.rest();
    if (begin > rest.size() || length > rest.size() - begin) return false;
    std::string_view after = rest.substr(begin + length);
    while (after.starts_with('\r') || after.starts_with('\n')) after.remove_prefix(1);
    return after.empty() || is_dataset_mark(after.substr(0, std::min(after.find('\n'), after.size())));
  }

  [[nodiscard]] ByteOrder byte_order(std::string_view fields) {
    const double order = take_number(fields).value_or(0), format = take_number(fields).value_or(0);
    if (format != 2) fail(fmt::format("floating-point format {} of dataset 58b (2, IEEE, is known)", format));
    if (options_.byte_order) return *options_.byte_order;
    if (order != 1 && order != 2) fail(fmt::format("byte order {} of dataset 58b (1 and 2 are known)", order));
    return order == 1 ? ByteOrder::little : ByteOrder::big;
  }

  std::vector<double> binary_values(const UniversalFunction& function, std::string_view fields) {
    const std::size_t size = function.is_double ? 8 : 4, row = function.values_per_sample() * size,
                      available = cursor_.rest().size();
    const std::size_t begin_of_file = cursor_.byte();
    const ByteOrder order = byte_order(fields);
    std::size_t count = function.count, begin = 0;
    if (count > available / row) {
      if (options_.incomplete == Incomplete::refuse)
        fail_at_byte(
            bytes_.size(),
            fmt::format("the file ends after {} of {} samples (values begin at byte {}; --incomplete takes them)",
                        available / row, count, begin_of_file + 1));
      pending_notes_.push_back(fmt::format("the file ends after {} of {} samples", available / row, count));
      count = available / row;
    } else {
      // A line end may have crept in before the values.
      const auto is_line_end = [&](std::size_t n) {
        return cursor_.rest().substr(0, n).find_first_not_of("\r\n") == std::string_view::npos;
      };
      while (begin < 3 && !(is_line_end(begin) && ends_behind(begin, count * row))) ++begin;
      if (begin == 3)
        fail_at_byte(
            begin_of_file + count * row,
            fmt::format("no -1 behind the {} bytes of values that begin at byte {}", count * row, begin_of_file + 1));
      if (begin > 0)
        pending_notes_.push_back(
            fmt::format("a stray line end at byte {} before the values: left out", begin_of_file + 1));
    }
    const std::string_view raw = cursor_.rest().substr(begin, count * row);
    require_plausible(raw, size, order, begin_of_file + begin);
    std::vector<double> values;
    values.reserve(raw.size() / size);
    for (std::size_t at = 0; at < raw.size(); at += size) {
      values.push_back(number_at(raw.data() + at, size, order));
      if (!std::isfinite(values.back())) fail_at_byte(begin_of_file + begin + at, "a value is not finite");
    }
    cursor_.skip(begin + count * row);
    skip_dataset();
    return values;
  }

  void require_plausible(std::string_view raw, std::size_t size, ByteOrder order, std::size_t byte) const {
    if (options_.byte_order) return;
    const ByteOrder other = order == ByteOrder::little ? ByteOrder::big : ByteOrder::little;
    const std::size_t stated = count_implausible(raw, size, order), swapped = count_implausible(raw, size, other);
    if (10 * stated > raw.size() / size && 10 * swapped < stated)
      fail_at_byte(byte, fmt::format("the values make sense only in the other byte order than the heading says "
                                     "(--byte-order {} takes them so)",
                                     other == ByteOrder::big ? "big" : "little"));
  }

  std::string name_;
  BinaryOptions options_;
  std::string bytes_;
  UniversalCursor cursor_;
  std::optional<UniversalUnits> units_;
  std::vector<Record> records_;
  std::vector<std::string> pending_notes_;
};

}  // namespace

bool is_universal_file(std::string_view head) {
  UniversalCursor cursor(head);
  std::string_view line;
  while (cursor.next_line(line))
    if (line.find_first_not_of(" \t") != line.npos) break;
  if (!is_dataset_mark(line) || !cursor.next_line(line)) return false;
  const std::optional<double> number = take_number(line);
  return number && *number > 0 && *number == std::floor(*number);
}

std::vector<Record> read_universal_file(const RecordFile& file, const BinaryOptions& options) {
  return UniversalReader(file, options).read();
}

}  // namespace impulse
