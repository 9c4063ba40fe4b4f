#include "lib/records/record_csv.hpp"

#include "lib/csv/csv_output.hpp"
#include "lib/records/record_unit.hpp"

namespace impulse {

std::vector<std::string> record_columns(const RecordHeader& header) {
  std::vector<std::string> names{column_name(header.abscissa.name, header.abscissa.unit)};
  for (const ChannelInfo& channel : header.channels) {
    if (!channel.is_complex) {
      names.push_back(column_name(channel.name, channel.unit));
      continue;
    }
    names.push_back(column_name(channel.name + "_real", channel.unit));
    names.push_back(column_name(channel.name + "_imaginary", channel.unit));
  }
  return names;
}

void write_record_csv(const std::string& path, RecordRows& rows) {
  CsvOutput output(path, record_columns(rows.header()));
  std::vector<double> row(rows.width());
  while (rows.next(row)) output.numbers(row);
  output.close();
}

}  // namespace impulse
