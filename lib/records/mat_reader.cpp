#include "lib/records/mat_file.hpp"

#include "lib/contract/errors.hpp"
#include "lib/records/even_time.hpp"
#include "lib/records/mat_arrays.hpp"
#include "lib/records/record_unit.hpp"
#include "lib/records/text_fields.hpp"
#include "lib/records/text_metadata.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

namespace impulse {
namespace {

/// One channel that a file may mean.
struct Column {
  std::string name;
  std::vector<double> real, imaginary;
};

std::string last_member(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? name : name.substr(dot + 1);
}

bool is_called_time(const std::string& name) {
  const std::string key = plain_key(parse_heading(last_member(name)).name);
  return key == "t" || key == "time" || key == "times" || key == "zeit" || key == "tvec" || key == "xvalues" ||
         key == "xdata";
}

std::vector<Column> columns_of_array(const MatArray& array) {
  const bool upright = array.rows >= array.columns;
  const std::size_t length = upright ? array.rows : array.columns, count = upright ? array.columns : array.rows;
  std::vector<Column> columns(count);
  for (std::size_t c = 0; c < count; ++c) {
    columns[c].name = count == 1 ? array.name : fmt::format("{}({})", array.name, c + 1);
    for (std::size_t i = 0; i < length; ++i) {
      const std::size_t at = upright ? c * length + i : i * count + c;
      columns[c].real.push_back(array.real[at]);
      if (array.is_complex) columns[c].imaginary.push_back(array.imaginary[at]);
    }
  }
  return columns;
}

bool increases(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), [](double a, double b) { return !(b > a); }) == values.end();
}

/// Start and step of values that are even but for rounding.
std::optional<EvenTime> even_times(const std::vector<double>& times) {
  EvenTimeFit fit;
  for (const double time : times) fit.add(time, 4e-16 * std::abs(times.back()));
  return fit.fit();
}

/// matio makes zeros of what a version-5 file lacks at its end: its variables must be whole before it is asked.
void require_whole_variables(const RecordFile& file) {
  const std::string head = file.head(128);
  if (!head.starts_with("MATLAB 5.0") || head.size() < 128) return;
  const bool big = head[126] == 'M';
  for (std::uint64_t at = 128; at < file.size();) {
    std::array<char, 8> tag{};
    std::uint64_t length = 0;
    const std::size_t count = file.read_at(at, tag.data(), tag.size());
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(tag[big ? 4 + i : 7 - i]);
    if (count < tag.size() || length > file.size() - at - tag.size())
      throw InputError(file.name(), 0, 0,
                       fmt::format("byte {}: the variable that begins here breaks off (the file has {} bytes)", at + 1,
                                   file.size()));
    at += tag.size() + length;
  }
}

class MatRecords {
 public:
  MatRecords(const RecordFile& file, const Sampling& sampling) : file_(file.name()), sampling_(sampling) {
    require_whole_variables(file);
    arrays_ = read_mat_arrays(file);
  }

  std::vector<Record> read() {
    const MatArray* own = find("abscissa.variable");
    if (own) return {own_record(*own)};
    std::map<std::size_t, std::vector<Column>> by_length;
    for (const MatArray& array : arrays_) {
      if (array.is_text || array.is_scalar() || array.real.empty()) continue;
      for (Column& column : columns_of_array(array)) by_length[column.real.size()].push_back(std::move(column));
    }
    std::vector<Record> records;
    for (auto& [length, columns] : by_length) add_record(columns, records);
    if (by_length.empty())
      throw InputError(file_, 0, 0, "no vector or matrix of numbers can be read (does the file break off?)");
    if (records.empty())
      throw InputError(file_, 0, 0,
                       fmt::format("no vector has times (there are: {}); give --step or --rate", names_of_vectors()));
    records.front().notes.insert(records.front().notes.end(), notes_.begin(), notes_.end());
    for (Record& record : records) record.metadata = metadata();
    return records;
  }

 private:
  [[nodiscard]] const MatArray* find(const std::string& name) const {
    const auto found =
        std::find_if(arrays_.begin(), arrays_.end(), [&](const MatArray& array) { return array.name == name; });
    return found == arrays_.end() ? nullptr : &*found;
  }
  [[nodiscard]] std::string text(const std::string& name) const {
    const MatArray* array = find(name);
    return array ? array->text : "";
  }
  [[nodiscard]] double scalar(const std::string& name) const {
    const MatArray* array = find(name);
    return array && array->is_scalar() ? array->real.front() : 0;
  }

  [[nodiscard]] std::vector<std::pair<std::string, std::string>> metadata() const {
    std::vector<std::pair<std::string, std::string>> entries;
    for (const MatArray& array : arrays_) {
      if (array.is_text) entries.emplace_back(array.name, array.text);
      if (array.is_scalar()) entries.emplace_back(array.name, fmt::format("{}", array.real.front()));
    }
    return entries;
  }

  [[nodiscard]] std::string names_of_vectors() const {
    std::vector<std::string> names;
    for (const MatArray& array : arrays_)
      if (!array.is_text && !array.is_scalar()) names.push_back(array.name);
    return fmt::format("{}", fmt::join(names, ", "));
  }

  /// What write_mat_file wrote.
  Record own_record(const MatArray& times) {
    Record record;
    record.format = "MATLAB file of ir-convert";
    record.abscissa = {text("abscissa.name"), text("abscissa.unit"), scalar("abscissa.start"), scalar("abscissa.step"),
                       0};
    const MatArray* values = find(times.text);
    if (!values)
      throw InputError(file_, 0, 0, fmt::format("no vector '{}', which abscissa.variable names", times.text));
    record.abscissa.size = values->real.size();
    if (!record.abscissa.is_even()) record.abscissa_values = values->real;
    for (std::size_t i = 1;; ++i) {
      std::string element = fmt::format("channels({})", i);
      if (i == 1 && find("channels.variable")) element = "channels";
      const MatArray* variable = find(element + ".variable");
      if (!variable) break;
      const MatArray* array = find(variable->text);
      if (!array || array->real.size() != record.abscissa.size)
        throw InputError(file_, 0, 0,
                         fmt::format("no vector '{}' of {} values, which {}.variable names", variable->text,
                                     record.abscissa.size, element));
      record.channels.push_back(
          {{text(element + ".name"), text(element + ".unit"), text(element + ".quantity"), array->is_complex},
           array->real,
           array->imaginary});
    }
    if (record.channels.empty()) throw InputError(file_, 0, 0, "no channels");
    require_finite(record);
    return record;
  }

  [[nodiscard]] std::optional<double> step_of_scalars() const {
    if (sampling_.step) return sampling_.step;
    for (const bool rate : {false, true})
      for (const MatArray& array : arrays_) {
        if (!array.is_scalar() || !(array.real.front() > 0)) continue;
        const std::string key = plain_key(parse_heading(last_member(array.name)).name);
        if (rate ? is_rate_key(key) : is_interval_key(key)) return rate ? 1 / array.real.front() : array.real.front();
      }
    return std::nullopt;
  }

  void add_record(std::vector<Column>& columns, std::vector<Record>& records) {
    Record record;
    record.format = "MATLAB file";
    record.abscissa.size = columns.front().real.size();
    if (record.abscissa.size < 2) return;
    if (!take_times(columns, record)) {
      for (const Column& column : columns) notes_.push_back(fmt::format("'{}' has no times: left out", column.name));
      return;
    }
    for (Column& column : columns) {
      const Heading heading =
          parse_heading(last_member(column.name) == column.name ? column.name : last_member(column.name));
      const std::string before = column.name.substr(0, column.name.size() - last_member(column.name).size());
      record.channels.push_back(
          {{before + heading.name, heading.unit, "", !column.imaginary.empty()}, column.real, column.imaginary});
    }
    if (record.channels.empty()) return;
    require_finite(record);
    records.push_back(std::move(record));
  }

  bool take_times(std::vector<Column>& columns, Record& record) {
    const std::optional<double> step = step_of_scalars();
    auto times =
        std::find_if(columns.begin(), columns.end(), [](const Column& column) { return is_called_time(column.name); });
    if (times == columns.end() && !step && columns.size() > 1 && columns.front().name.ends_with("(1)") &&
        increases(columns.front().real)) {
      times = columns.begin();
      record.notes.push_back(fmt::format("'{}' increases: taken as the times", times->name));
    }
    const bool has_times = times != columns.end();
    if (!has_times && !step) return false;
    if (sampling_.step || !has_times) {
      record.abscissa.step = *step;
      record.abscissa.start = sampling_.start.value_or(0);
    } else {
      take_time_values(*times, record);
    }
    if (has_times) columns.erase(times);
    return true;
  }

  void take_time_values(const Column& times, Record& record) const {
    const std::optional<RecordUnit> unit = record_unit(parse_heading(last_member(times.name)).unit);
    const double factor = unit && unit->si == "s" ? unit->factor : 1;
    if (!unit) record.notes.push_back(fmt::format("'{}' states no unit: taken as seconds", times.name));
    if (const std::optional<EvenTime> even = even_times(times.real)) {
      record.abscissa.start = even->start * factor;
      record.abscissa.step = even->step * factor;
      return;
    }
    if (!increases(times.real))
      throw InputError(file_, 0, 0, fmt::format("the times of '{}' do not increase", times.name));
    for (const double time : times.real) record.abscissa_values.push_back(time * factor);
    record.notes.push_back(fmt::format("'{}' is uneven", times.name));
  }

  void require_finite(const Record& record) const {
    const auto is_finite = [](const std::vector<double>& values) {
      return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
    };
    for (const Channel& channel : record.channels)
      if (!is_finite(channel.values) || !is_finite(channel.imaginary))
        throw InputError(file_, 0, 0, fmt::format("'{}' has values that are not finite", channel.info.name));
    const Abscissa& abscissa = record.abscissa;
    if (!is_finite(record.abscissa_values) || !std::isfinite(abscissa.start) || !std::isfinite(abscissa.step) ||
        abscissa.step < 0)
      throw InputError(file_, 0, 0, "the times are not finite");
  }

  std::string file_;
  Sampling sampling_;
  std::vector<MatArray> arrays_;
  std::vector<std::string> notes_;
};

}  // namespace

bool is_mat_file(std::string_view head) {
  return head.starts_with("MATLAB 5.0 MAT-file") || head.starts_with("MATLAB 7.3 MAT-file") ||
         head.starts_with("\x89HDF\r\n");
}

std::vector<Record> read_mat_file(const RecordFile& file, const Sampling& sampling) {
  return MatRecords(file, sampling).read();
}

}  // namespace impulse
