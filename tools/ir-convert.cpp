#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_output.hpp"
#include "lib/records/mat_file.hpp"
#include "lib/records/record_conversion.hpp"
#include "lib/records/record_csv.hpp"
#include "lib/records/record_format.hpp"
#include "lib/records/universal_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace {

using namespace impulse;
using Calibration = RecordConversion::Calibration;

enum class OutputFormat { csv, universal, universal_binary, mat, mat73 };

struct Options {
  std::vector<std::string> files;
  RecordFormat format = RecordFormat::automatic;
  std::optional<std::size_t> record;
  bool list_channels = false;
  bool list_metadata = false;
  bool zero_time = false;
  bool quiet = false;
  RecordConversion conversion;
  std::vector<Calibration> sensitivities;
  TextOptions text;
  std::optional<std::string> delimiter;
  std::optional<char> decimal_sign;
  std::optional<double> step, rate, start;
  std::optional<OutputFormat> to;
  bool incomplete = false;
  std::optional<ByteOrder> byte_order;
  std::string output;
};

const ToolPage page{
    "ir-convert",
    "Convert the record of an oscilloscope, recorder or analyser to CSV in SI units, or to a universal or MATLAB file.",
    "Reads delimited text (any delimiter, decimal point or comma, headings, any line ends, UTF-8, "
    "Latin-1 and others), Tektronix "
    "oscilloscope CSV, LabVIEW .lvm, Dewesoft text, transient recorders' text, Los Alamos "
    "Kolsky-bar .raw files, universal files (datasets 58 and 58b), MATLAB files (v4, v5, v7.3) and WAV. Says on "
    "standard "
    "error what it saw, what it took for granted and what it repaired. A column of times that was rounded "
    "until values repeat is rebuilt from the rate.\n"
    "CHANNEL is a name or a number from 1, as --list-channels shows them. A file that holds several records of "
    "different times (segments of a .lvm, channels of a universal or MATLAB file) lists them with the number of "
    "their record.",
    "printf 'Time (ms);Force (kN)\\n0,0;0\\n0,1;1,5\\n0,2;3,25\\n' > record.txt\n"
    "ir-convert record.txt --list-channels\n"
    "ir-convert record.txt --rename Force=force -o force.csv"};

char parse_delimiter(const std::string& text) {
  if (text == "tab" || text == "\\t") return '\t';
  if (text == "blanks" || text == " ") return ' ';
  if (text.size() != 1)
    throw UsageError("--delimiter", fmt::format("'{}' is not one character, 'tab' or 'blanks'", text));
  return text.front();
}

void declare(Command& command, Options& options) {
  command.files("FILE", options.files, 0, 1, "record; '-' or none is standard input");
  command.choice("--format", options.format,
                 {{"auto", RecordFormat::automatic},
                  {"text", RecordFormat::delimited},
                  {"tektronix", RecordFormat::tektronix},
                  {"lvm", RecordFormat::labview},
                  {"dewesoft", RecordFormat::dewesoft},
                  {"transient", RecordFormat::transient},
                  {"kolsky", RecordFormat::lanl},
                  {"uff", RecordFormat::universal},
                  {"mat", RecordFormat::matlab},
                  {"wav", RecordFormat::wav}},
                 "format of the record");
  command.count("--record", options.record, 1,
                "take this record of a file that holds several, counted from 1: a segment of a .lvm, channels that "
                "have times of their own (default: the only one, or that of the --channel)");
  command.flag("--list-channels", options.list_channels,
               "write the channels instead, as CSV with their unit, samples, times and extremes");
  command.flag("--list-metadata", options.list_metadata, "write what else the record says instead, as CSV key,value");
  command.text("--channel", options.conversion.channels, "CHANNEL", "take this channel only; may be repeated");
  command.parsed<RecordConversion::Named>("--rename", options.conversion.names, parse_named, "CHANNEL=NAME",
                                          "give a channel another name");
  command.parsed<RecordConversion::Named>("--unit", options.conversion.units, parse_named, "CHANNEL=UNIT",
                                          "unit of the values in the record, if it says none or a wrong one");
  command.parsed<Calibration>(
      "--scale", options.conversion.calibrations,
      [](const std::string& text) { return parse_calibration(text, Calibration::Use::multiply); }, "CHANNEL=FACTOR",
      "multiply a channel: 3 or 400N/V");
  command.parsed<Calibration>(
      "--sensitivity", options.sensitivities,
      [](const std::string& text) { return parse_calibration(text, Calibration::Use::divide); }, "CHANNEL=FACTOR",
      "divide a channel: 2.25mV/N");
  command.quantity("--step", options.step, "s", Sign::positive, "time step, if the record says none or a wrong one");
  command.quantity("--rate", options.rate, "Hz", Sign::positive, "sampling rate, instead of --step");
  command.quantity("--start", options.start, "s", Sign::any, "time of the first sample, with --step or --rate");
  command.text("--time-column", options.text.abscissa_column, "CHANNEL",
               "column of the times in a text, 'none' if there is none");
  command.quantity("--from", options.conversion.from, "s", Sign::any, "leave out what comes before this time");
  command.quantity("--to", options.conversion.to, "s", Sign::any, "leave out what comes after this time");
  command.flag("--zero-time", options.zero_time, "count time from the first sample, as the other tools want it");
  command.text("--delimiter", options.delimiter, "CHARACTER",
               "between the fields of a text: a character, 'tab' or 'blanks'");
  command.choice("--decimal", options.decimal_sign, {{"point", '.'}, {"comma", ','}}, "decimal sign of a text");
  command.text("--encoding", options.text.encoding, "NAME", "of a text's letters, as iconv calls it");
  command.flag("--incomplete", options.incomplete, "take what there is of a record that breaks off (uff, wav)");
  command.choice("--byte-order", options.byte_order, {{"little", ByteOrder::little}, {"big", ByteOrder::big}},
                 "of binary values (uff), instead of what the file says");
  command.choice("--as", options.to,
                 {{"csv", OutputFormat::csv},
                  {"uff58", OutputFormat::universal},
                  {"uff58b", OutputFormat::universal_binary},
                  {"mat", OutputFormat::mat},
                  {"mat73", OutputFormat::mat73}},
                 "format to write: csv, unless the output's name ends in .uff or .unv (uff58b) or .mat. uff58 has 13 "
                 "digits, 6 of uneven "
                 "times; the others lose nothing");
  command.flag("--quiet", options.quiet, "say nothing of what was seen");
  command.output(options.output);
}

ReadOptions read_options(const Options& options) {
  if (options.step && options.rate) throw UsageError("--rate", "--step says the same");
  if (options.start && !options.step && !options.rate) throw UsageError("--start", "it goes with --step or --rate");
  if (options.to && (options.list_channels || options.list_metadata)) throw UsageError("--as", "a list is always CSV");
  if (options.list_channels && options.list_metadata)
    throw UsageError("--list-metadata", "--list-channels writes something else");
  ReadOptions read{options.format, options.text, {options.step, options.start}, {}};
  if (options.rate) read.sampling.step = 1 / *options.rate;
  if (options.delimiter) read.text.delimiter = parse_delimiter(*options.delimiter);
  read.text.decimal_sign = options.decimal_sign;
  read.binary = {options.incomplete ? Incomplete::take : Incomplete::refuse, options.byte_order};
  return read;
}

RecordConversion conversion_of(const Options& options) {
  RecordConversion conversion = options.conversion;
  for (Calibration& calibration : conversion.calibrations) calibration.flag = "--scale";
  for (Calibration calibration : options.sensitivities) {
    calibration.flag = "--sensitivity";
    conversion.calibrations.push_back(calibration);
  }
  if (options.zero_time) conversion.origin = RecordConversion::Origin::first_sample;
  return conversion;
}

void say(const std::string& file, const std::string& what) {
  fmt::print(stderr, "{}: {}: {}\n", page.name, file, what);
}

void list_metadata(const RecordHeader& header, const std::string& path) {
  CsvOutput output(path, {"key", "value"});
  for (const auto& [key, value] : header.metadata) output.row({key, value});
  output.close();
}

void list_record(RecordRows& rows, std::size_t record, std::size_t& number, CsvOutput& output) {
  const RecordHeader& header = rows.header();
  const std::vector<std::string> columns = record_columns(header);
  struct Extremes {
    double least = INFINITY, most = -INFINITY;
  };
  std::vector<double> row(rows.width());
  std::vector<Extremes> extremes(rows.width());
  while (rows.next(row))
    for (std::size_t i = 0; i < row.size(); ++i)
      extremes[i] = {std::min(extremes[i].least, row[i]), std::max(extremes[i].most, row[i])};
  const Abscissa& abscissa = header.abscissa;
  std::size_t column = 1;
  for (const ChannelInfo& channel : header.channels) {
    ++number;
    for (std::size_t part = 0; part < (channel.is_complex ? 2U : 1U); ++part, ++column)
      output.row({static_cast<double>(number), channel.name, columns[column], channel.unit, channel.quantity,
                  static_cast<double>(abscissa.size), extremes[0].least,
                  abscissa.is_even() ? std::optional<double>(abscissa.step) : std::nullopt, extremes[0].most,
                  extremes[column].least, extremes[column].most, static_cast<double>(record)});
  }
}

void list_channels(std::vector<std::unique_ptr<RecordRows>>& records, std::size_t first, const std::string& path) {
  CsvOutput output(path, {"channel", "name", "column", "unit", "quantity", "samples", "start", "step", "end", "minimum",
                          "maximum", "record"});
  std::size_t number = 0;
  for (std::size_t r = 0; r < records.size(); ++r) list_record(*records[r], first + r, number, output);
  output.close();
}

void keep_record(std::size_t number, std::vector<std::unique_ptr<RecordRows>>& records) {
  if (number > records.size())
    throw UsageError("--record", fmt::format("the file has {} record{}, not {}", records.size(),
                                             records.size() == 1 ? "" : "s", number));
  std::unique_ptr<RecordRows> kept = std::move(records[number - 1]);
  records.clear();
  records.push_back(std::move(kept));
}

OutputFormat output_format(const Options& options) {
  if (options.to) return *options.to;
  const std::string extension = std::filesystem::path(options.output).extension().string();
  if (extension == ".uff" || extension == ".unv") return OutputFormat::universal_binary;
  return extension == ".mat" ? OutputFormat::mat : OutputFormat::csv;
}

/// The only record, or the one that has the channels asked for: those of several are counted through.
std::unique_ptr<RecordRows> chosen_record(std::vector<std::unique_ptr<RecordRows>>& records,
                                          RecordConversion& conversion) {
  if (records.size() == 1) return std::move(records.front());
  std::vector<ChannelInfo> all;
  std::vector<std::size_t> owners, places;
  for (std::size_t r = 0; r < records.size(); ++r)
    for (std::size_t i = 0; i < records[r]->header().channels.size(); ++i) {
      all.push_back(records[r]->header().channels[i]);
      owners.push_back(r);
      places.push_back(i);
    }
  if (conversion.channels.empty())
    throw UsageError("--channel", fmt::format("the file has {} records of different times: say which channels of one "
                                              "of them (--list-channels lists them), or --record",
                                              records.size()));
  const std::size_t owner = owners[channel_index(all, conversion.channels.front(), "--channel")];
  const auto within = [&](std::string& channel, const char* flag) {
    const std::size_t index = channel_index(all, channel, flag);
    if (owners[index] != owner)
      throw UsageError(flag,
                       fmt::format("channel '{}' has other times than '{}'", channel, conversion.channels.front()));
    channel = std::to_string(places[index] + 1);
  };
  for (RecordConversion::Named& name : conversion.names) within(name.channel, "--rename");
  for (RecordConversion::Named& unit : conversion.units) within(unit.channel, "--unit");
  for (Calibration& calibration : conversion.calibrations) within(calibration.channel, "--scale");
  std::vector<std::string> chosen = conversion.channels;
  for (std::string& channel : chosen) within(channel, "--channel");
  conversion.channels = chosen;
  return std::move(records[owner]);
}

void write(const Options& options, RecordRows& record) {
  const OutputFormat format = output_format(options);
  if (format == OutputFormat::csv) return write_record_csv(options.output, record);
  const Record collected = collect_record(record);
  if (format == OutputFormat::universal || format == OutputFormat::universal_binary)
    write_universal_file(options.output, collected,
                         format == OutputFormat::universal ? UniversalForm::text : UniversalForm::binary);
  else
    write_mat_file(options.output, collected, format == OutputFormat::mat ? MatVersion::v5 : MatVersion::v73);
}

int run(const Options& options) {
  const ReadOptions read = read_options(options);
  RecordConversion conversion = conversion_of(options);
  const RecordFile file(options.files.front());
  std::vector<std::unique_ptr<RecordRows>> records = read_records(file, read);
  if (!options.quiet && records.size() > 1)
    say(file.name(), fmt::format("{} records, each with times of its own", records.size()));
  if (options.record) keep_record(*options.record, records);
  if (!options.quiet) say(file.name(), records.front()->header().format);
  if (options.list_metadata) {
    list_metadata(records.front()->header(), options.output);
    return 0;
  }
  if (!options.list_channels || !conversion.channels.empty()) {
    std::unique_ptr<RecordRows> record = chosen_record(records, conversion);
    records.clear();
    records.push_back(std::move(record));
  }
  for (std::unique_ptr<RecordRows>& record : records) {
    record = converted_record(std::move(record), conversion);
    if (!options.quiet)
      for (const std::string& note : record->header().notes) say(file.name(), note);
  }
  if (options.list_channels)
    list_channels(records, options.record.value_or(1), options.output);
  else
    write(options, *records.front());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Command command(page);
  declare(command, options);
  return run_tool(argc, argv, command, [&] { return run(options); });
}
