#include "lib/records/text_record.hpp"

#include "lib/contract/errors.hpp"
#include "lib/records/even_time.hpp"
#include "lib/records/record_unit.hpp"
#include "lib/records/text_heading.hpp"
#include "lib/records/text_lines.hpp"
#include "lib/records/text_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace impulse {
namespace {

// Fewer values, if not even as they are, are taken for uneven.
constexpr std::size_t fewest_rounded = 10;

double in_unit(double value, const RecordUnit& unit) {
  const double inverse = std::nearbyint(1 / unit.factor);
  return std::abs(inverse * unit.factor - 1) < 1e-12 ? value / inverse : value * unit.factor;
}

class TextRecord : public RecordRows {
 public:
  TextRecord(const RecordFile& file, TextLayout layout, const Sampling& sampling)
      : file_(file), layout_(std::move(layout)), row_(file.name(), layout_) {
    header_.format = layout_.format;
    header_.metadata = layout_.metadata;
    header_.notes = layout_.notes;
    for (const TextColumn& column : layout_.columns) {
      if (column.role == TextColumn::Role::value) header_.channels.push_back({column.name, column.unit, "", false});
      if (column.role == TextColumn::Role::abscissa) abscissa_ = &column;
    }
    if (header_.channels.empty())
      throw InputError(file.name(), layout_.first_line, 0, "no column of numbers besides the time");
    values_.resize(width());
    find_sampling(sampling);
  }

  [[nodiscard]] const RecordHeader& header() const override { return header_; }

  [[nodiscard]] bool next(std::span<double> row) override {
    std::string_view line;
    if (index_ < header_.abscissa.size && !lines_) lines_.emplace(file_, layout_.begin);
    if (index_ == header_.abscissa.size || !next_row(*lines_, line)) {
      lines_.reset();  // a file may have thousands of segments
      return false;
    }
    require_whole(row_.parse(line, lines_->number(), row), lines_->number());
    row[0] = header_.abscissa.is_even() ? header_.abscissa.at(index_) : in_unit(row[0], abscissa_unit_);
    ++index_;
    return true;
  }

 private:
  void require_whole(std::size_t fields, std::size_t line) const {
    if (fields < row_.field_count())
      throw InputError(file_.name(), line, fields + 1,
                       fmt::format("the row breaks off after {} of {} fields", fields, row_.field_count()));
  }

  /// The next line that counts as a row, from `lines` of this record's part of the file.
  [[nodiscard]] bool next_row(TextLines& lines, std::string_view& line) const {
    while (lines.number() < layout_.last_line && lines.next(line))
      if (lines.number() >= layout_.first_line && TextRow::counts(line)) return true;
    return false;
  }

  /// Calls `use` for every row but a last one that breaks off.
  template <class Use>
  void for_each_row(const Use& use) {
    TextLines lines(file_, layout_.begin);
    std::string_view line;
    std::string last;
    std::size_t last_number = 0;
    while (next_row(lines, line)) {
      if (last_number > 0) use(std::string_view(last), last_number);
      last.assign(line);
      last_number = lines.number();
    }
    if (last_number == 0) return;
    const std::size_t fields = row_.parse(last, last_number, values_);
    if (fields == row_.field_count()) return use(std::string_view(last), last_number);
    broken_line_ = last_number;
    broken_fields_ = fields;
  }

  void find_sampling(const Sampling& sampling) {
    Abscissa& abscissa = header_.abscissa;
    if (!sampling.step) set_abscissa_unit();
    if (abscissa_ && !sampling.step && !layout_.step)
      fit_times();
    else
      take_known_step(sampling);
    if (sampling.start && abscissa.is_even()) abscissa.start = *sampling.start;
    if (broken_line_ > 0)
      header_.notes.push_back(fmt::format("the last line ({}) breaks off after {} of {} fields: left out", broken_line_,
                                          broken_fields_, row_.field_count()));
    if (abscissa.size == 0) throw InputError(file_.name(), layout_.first_line, 0, "no whole row");
  }

  void set_abscissa_unit() {
    if (!abscissa_) return;
    const std::string spelled = abscissa_->unit == "S" ? "s" : abscissa_->unit;
    const std::optional<RecordUnit> unit = record_unit(spelled);
    if (!unit && !is_no_unit(spelled))
      throw InputError(
          file_.name(), 0, 0,
          fmt::format("column '{}' is in '{}', which is no unit of time that is known: give --step or --rate",
                      abscissa_->name, spelled));
    if (unit) {
      abscissa_unit_ = *unit;
    } else {
      abscissa_unit_ = {"s", 1, 0};
      header_.notes.push_back(fmt::format("column '{}' has no unit that is known: taken as seconds", abscissa_->name));
    }
    header_.abscissa.unit = abscissa_unit_.si;
    header_.abscissa.name = abscissa_unit_.si == "s"    ? "time"
                            : abscissa_unit_.si == "Hz" ? "frequency"
                                                        : abscissa_->name;
  }

  void take_known_step(const Sampling& sampling) {
    Abscissa& abscissa = header_.abscissa;
    const std::optional<double> step = sampling.step ? sampling.step : layout_.step;
    if (!step)
      throw InputError(file_.name(), 0, 0,
                       "no column of times and no sample interval in the heading: give --step or --rate, or name the "
                       "column of times with --time-column");
    if (sampling.step && abscissa_)
      header_.notes.push_back(fmt::format("column '{}' is replaced by the step given, {} s", abscissa_->name, *step));
    abscissa.step = *step;
    abscissa.start = layout_.start.value_or(0);
    double first = 0, last = 0, half_digit = 0;
    const PrintedDigits digits = abscissa_ ? printed_digits() : PrintedDigits();
    for_each_row([&](std::string_view line, std::size_t number) {
      if (abscissa_ && !sampling.step) {
        const TextRow::Printed printed = row_.abscissa(line, number);
        half_digit = std::max(half_digit, digits.half_digit(printed.text));
        (abscissa.size == 0 ? first : last) = printed.value;
      }
      ++abscissa.size;
    });
    if (!abscissa_ || sampling.step) return;
    abscissa.start = in_unit(first, abscissa_unit_);
    if (abscissa.size < 2) return;
    header_.notes.push_back(fmt::format("time from the sample interval {} s ({}), not from column '{}'", *step,
                                        layout_.step_source, abscissa_->name));
    const double length = static_cast<double>(abscissa.size - 1) * *step;
    const double said = in_unit(last - first, abscissa_unit_), room = in_unit(2 * half_digit, abscissa_unit_) + *step;
    if (std::abs(said - length) > 1e-3 * length + room)
      throw InputError(file_.name(), layout_.first_line, 0,
                       fmt::format("{} says a step of {} s, the times one of {} s: give --step", layout_.step_source,
                                   *step, said / static_cast<double>(abscissa.size - 1)));
  }

  /// How the first thousands of times are printed.
  PrintedDigits printed_digits() {
    PrintedDigits digits;
    TextLines lines(file_, layout_.begin);
    std::string_view line;
    for (std::size_t count = 0; count < 5000 && next_row(lines, line); ++count) {
      try {
        digits.add(row_.abscissa(line, lines.number()).text);
      } catch (const InputError&) {
        break;  // a last row may break off; any other is refused when its turn comes
      }
    }
    return digits;
  }

  struct Explanation {
    const char* words;
    double (*half_width)(double value, double half_digit, double step);
  };

  void fit_times() {
    static constexpr std::array explanations{
        Explanation{"rounded", [](double, double half_digit, double) { return half_digit; }},
        Explanation{"cut off", [](double, double half_digit, double) { return 2 * half_digit; }},
        Explanation{"uneven by less than a thousandth of a step",
                    [](double, double, double step) { return 1e-3 * step; }},
        Explanation{"in single precision", [](double value, double, double) { return 6e-8 * std::abs(value); }}};
    double mean_step = 0;
    const PrintedDigits digits = printed_digits();
    for (const Explanation& explanation : explanations) {
      EvenTimeFit fit;
      double first = 0, last = 0, least = INFINITY, most = -INFINITY;
      std::size_t repeated = 0;
      for_each_row([&](std::string_view line, std::size_t number) {
        const TextRow::Printed printed = row_.abscissa(line, number);
        const double value = printed.value;
        if (fit.size() > 0) {
          least = std::min(least, value - last);
          most = std::max(most, value - last);
          repeated += value == last ? 1 : 0;
        } else {
          first = value;
        }
        last = value;
        fit.add(value, explanation.half_width(value, digits.half_digit(printed.text), mean_step));
      });
      header_.abscissa.size = fit.size();
      if (fit.size() < 2)
        throw InputError(file_.name(), layout_.first_line, 0, "one row only (a record needs at least two)");
      mean_step = (last - first) / static_cast<double>(fit.size() - 1);
      const std::optional<EvenTime> even = fit.fit();
      // Any few values are those of some even step, rounded.
      if (even && (fit.size() >= fewest_rounded || most - least <= 1e-3 * mean_step))
        return take_even(*even, explanation.words, repeated, most - least);
    }
    require_increasing();
    header_.notes.push_back(fmt::format("'{}' is uneven", abscissa_->name));
  }

  void take_even(const EvenTime& even, const char* words, std::size_t repeated, double spread) {
    Abscissa& abscissa = header_.abscissa;
    abscissa.start = in_unit(even.start, abscissa_unit_);
    abscissa.step = in_unit(even.step, abscissa_unit_);
    if (spread <= 1e-6 * even.step) return;
    header_.notes.push_back(fmt::format(
        "column '{}' is {}{}: rebuilt from {} {} in steps of {} {} (its digits leave {:.6g} to {:.6g})",
        abscissa_->name, words, repeated > 0 ? fmt::format(", {} values repeat the one before", repeated) : "",
        abscissa.start, abscissa.unit, abscissa.step, abscissa.unit, in_unit(even.least_step, abscissa_unit_),
        in_unit(even.most_step, abscissa_unit_)));
  }

  void require_increasing() {
    double last = -INFINITY;
    for_each_row([&](std::string_view line, std::size_t number) {
      const TextRow::Printed printed = row_.abscissa(line, number);
      if (!(printed.value > last))
        throw InputError(file_.name(), number, 0,
                         fmt::format("time {} follows {}, and no even step explains the times: give --step, or "
                                     "--time-column if this isn't the time",
                                     printed.text, last));
      last = printed.value;
    });
  }

  const RecordFile& file_;
  TextLayout layout_;
  TextRow row_;
  std::optional<TextLines> lines_;
  RecordHeader header_;
  const TextColumn* abscissa_ = nullptr;
  RecordUnit abscissa_unit_{"s", 1, 0};
  std::vector<double> values_;
  std::size_t index_ = 0;
  std::size_t broken_line_ = 0, broken_fields_ = 0;
};

}  // namespace

std::vector<std::unique_ptr<RecordRows>> read_text_records(const RecordFile& file, TextDialect dialect,
                                                           const TextOptions& options, const Sampling& sampling) {
  std::vector<std::unique_ptr<RecordRows>> records;
  for (TextLayout& layout : text_layouts(file, dialect, options))
    records.push_back(std::make_unique<TextRecord>(file, std::move(layout), sampling));
  return records;
}

}  // namespace impulse
