#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace impulse {

/// What a record says about one of its channels.
struct ChannelInfo {
  std::string name;
  std::string unit;      ///< as the record spells it; "" if it says none
  std::string quantity;  ///< "acceleration", ...; "" if the record doesn't say
  bool is_complex = false;
};

/// What the values of a record belong to: time, or the frequency of a spectrum.
struct Abscissa {
  std::string name = "time";
  std::string unit = "s";  ///< SI
  double start = 0;
  double step = 0;  ///< 0: uneven, every row says its own
  std::size_t size = 0;

  [[nodiscard]] bool is_even() const { return step > 0; }
  /// start + index·step, as a quotient of whole numbers where start and step are 1/n to rounding: sample 3 of a record
  /// that begins at -50 µs with a step of 0.1 µs is at -4.97e-05, not -4.9699999999999994e-05.
  [[nodiscard]] double at(std::size_t index) const;
};

/// What a record says apart from its values.
struct RecordHeader {
  std::string format;  ///< in words, for the user: `LabVIEW measurement (.lvm)`
  Abscissa abscissa;
  std::vector<ChannelInfo> channels;
  std::vector<std::pair<std::string, std::string>> metadata;
  std::vector<std::string> notes;  ///< what was found odd, taken for granted or repaired; one line each
};

/// A record in rows, in the units of the file: the one form in which all formats are read. A row is the abscissa and
/// the channels one after the other, a complex channel as real and imaginary part.
class RecordRows {
 public:
  RecordRows() = default;
  RecordRows(const RecordRows&) = delete;
  RecordRows& operator=(const RecordRows&) = delete;
  virtual ~RecordRows() = default;

  [[nodiscard]] virtual const RecordHeader& header() const = 0;

  /// Number of values in a row.
  [[nodiscard]] std::size_t width() const;

  /// Reads the next row into `row`, which has width() values; false at the end.
  /// @throws InputError at what is wrong in the file.
  [[nodiscard]] virtual bool next(std::span<double> row) = 0;
};

/// A channel in memory.
struct Channel {
  ChannelInfo info;
  std::vector<double> values;
  std::vector<double> imaginary;  ///< as many as values if it is complex, else none
};

/// A record in memory.
struct Record {
  std::string format;
  Abscissa abscissa;
  std::vector<double> abscissa_values;  ///< of an uneven abscissa, else none
  std::vector<Channel> channels;
  std::vector<std::pair<std::string, std::string>> metadata;
  std::vector<std::string> notes;
};

[[nodiscard]] RecordHeader header_of(const Record& record);

/// The rows of a record in memory.
[[nodiscard]] std::unique_ptr<RecordRows> record_rows(Record record);

/// All rows, into memory; the abscissa's size becomes what there is.
/// Verified by: tests/lib/record.test.cpp
[[nodiscard]] Record collect_record(RecordRows& rows);

}  // namespace impulse
