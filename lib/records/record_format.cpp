#include "lib/records/record_format.hpp"

#include "lib/contract/errors.hpp"
#include "lib/records/mat_file.hpp"
#include "lib/records/universal_file.hpp"
#include "lib/records/wav_file.hpp"

#include <fmt/format.h>

namespace impulse {
namespace {

TextDialect dialect(RecordFormat format) {
  switch (format) {
    case RecordFormat::delimited:
      return TextDialect::delimited;
    case RecordFormat::tektronix:
      return TextDialect::tektronix;
    case RecordFormat::labview:
      return TextDialect::labview;
    case RecordFormat::dewesoft:
      return TextDialect::dewesoft;
    case RecordFormat::transient:
      return TextDialect::transient;
    case RecordFormat::lanl:
      return TextDialect::lanl;
    default:
      return TextDialect::any;
  }
}

RecordFormat format_of(const RecordFile& file) {
  const std::string head = file.head(4096);
  if (is_mat_file(head)) return RecordFormat::matlab;
  if (is_wav_file(head)) return RecordFormat::wav;
  return is_universal_file(head) ? RecordFormat::universal : RecordFormat::automatic;
}

/// No option is accepted and ignored.
void require_use(const ReadOptions& options, RecordFormat format) {
  const bool is_universal = format == RecordFormat::universal, is_wav = format == RecordFormat::wav;
  const bool is_text = !is_universal && !is_wav && format != RecordFormat::matlab;
  const auto require_text = [&](bool given, const char* flag) {
    if (given && !is_text) throw UsageError(flag, "the record is no text");
  };
  require_text(options.text.delimiter.has_value(), "--delimiter");
  require_text(options.text.decimal_sign.has_value(), "--decimal");
  require_text(options.text.encoding.has_value(), "--encoding");
  require_text(options.text.abscissa_column.has_value(), "--time-column");
  if (options.binary.incomplete == Incomplete::take && !is_universal && !is_wav)
    throw UsageError("--incomplete",
                     "it goes with universal and WAV files (a text's broken last row is left out without it)");
  if (options.binary.byte_order && !is_universal) throw UsageError("--byte-order", "it goes with universal files");
}

/// Formats that say their own sampling; what the user says replaces it.
void replace_sampling(Record& record, const Sampling& sampling) {
  if (!sampling.step) return;
  record.notes.push_back(fmt::format("the step is the one given, {} s", *sampling.step));
  record.abscissa = {"time", "s", sampling.start.value_or(0), *sampling.step, record.abscissa.size};
  record.abscissa_values.clear();
}

}  // namespace

std::vector<std::unique_ptr<RecordRows>> read_records(const RecordFile& file, const ReadOptions& options) {
  const RecordFormat format = options.format == RecordFormat::automatic ? format_of(file) : options.format;
  require_use(options, format);
  std::vector<Record> found;
  if (format == RecordFormat::universal) found = read_universal_file(file, options.binary);
  if (format == RecordFormat::matlab) found = read_mat_file(file, options.sampling);
  if (format == RecordFormat::wav) found.push_back(read_wav_file(file, options.binary.incomplete));
  std::vector<std::unique_ptr<RecordRows>> records;
  if (found.empty()) return read_text_records(file, dialect(format), options.text, options.sampling);
  for (Record& record : found) {
    if (format != RecordFormat::matlab) replace_sampling(record, options.sampling);
    records.push_back(record_rows(std::move(record)));
  }
  return records;
}

}  // namespace impulse
