#include "lib/records/record.hpp"

#include "lib/contract/require.hpp"

#include <cmath>

namespace impulse {
namespace {

class MemoryRows : public RecordRows {
 public:
  explicit MemoryRows(Record record) : record_(std::move(record)), header_(header_of(record_)) {
    const std::size_t places = header_.abscissa.is_even() ? 0 : header_.abscissa.size;
    require(record_.abscissa_values.size() == places, "an uneven abscissa of {} samples has {} values",
            header_.abscissa.size, record_.abscissa_values.size());
    for (const Channel& channel : record_.channels) {
      require(channel.values.size() == header_.abscissa.size, "channel {} has {} values, the record {}",
              channel.info.name, channel.values.size(), header_.abscissa.size);
      require(channel.imaginary.size() == (channel.info.is_complex ? header_.abscissa.size : 0),
              "channel {} has {} imaginary parts", channel.info.name, channel.imaginary.size());
    }
  }

  [[nodiscard]] const RecordHeader& header() const override { return header_; }

  [[nodiscard]] bool next(std::span<double> row) override {
    if (index_ == header_.abscissa.size) return false;
    std::size_t column = 0;
    row[column++] = header_.abscissa.is_even() ? header_.abscissa.at(index_) : record_.abscissa_values[index_];
    for (const Channel& channel : record_.channels) {
      row[column++] = channel.values[index_];
      if (channel.info.is_complex) row[column++] = channel.imaginary[index_];
    }
    ++index_;
    return true;
  }

 private:
  Record record_;
  RecordHeader header_;
  std::size_t index_ = 0;
};

}  // namespace

double Abscissa::at(std::size_t index) const {
  const double per_unit = std::nearbyint(1 / step);
  if (std::abs(per_unit * step - 1) < 4e-16)
    for (const double parts : {1.0, 2.0, 10.0, 100.0, 1000.0}) {
      const double before = std::nearbyint(start * per_unit * parts);
      if (std::abs(before / (per_unit * parts) - start) <= 4e-16 * std::abs(start))
        return (before + parts * static_cast<double>(index)) / (per_unit * parts);
    }
  return start + step * static_cast<double>(index);
}

std::size_t RecordRows::width() const {
  std::size_t count = 1;
  for (const ChannelInfo& channel : header().channels) count += channel.is_complex ? 2 : 1;
  return count;
}

RecordHeader header_of(const Record& record) {
  RecordHeader header{record.format, record.abscissa, {}, record.metadata, record.notes};
  for (const Channel& channel : record.channels) header.channels.push_back(channel.info);
  return header;
}

std::unique_ptr<RecordRows> record_rows(Record record) { return std::make_unique<MemoryRows>(std::move(record)); }

Record collect_record(RecordRows& rows) {
  const RecordHeader& header = rows.header();
  Record record{header.format, header.abscissa, {}, {}, header.metadata, header.notes};
  for (const ChannelInfo& info : header.channels) record.channels.push_back({info, {}, {}});
  std::vector<double> row(rows.width());
  record.abscissa.size = 0;
  while (rows.next(row)) {
    std::size_t column = 0;
    if (!header.abscissa.is_even()) record.abscissa_values.push_back(row[column]);
    ++column;
    for (Channel& channel : record.channels) {
      channel.values.push_back(row[column++]);
      if (channel.info.is_complex) channel.imaginary.push_back(row[column++]);
    }
    ++record.abscissa.size;
  }
  return record;
}

}  // namespace impulse
