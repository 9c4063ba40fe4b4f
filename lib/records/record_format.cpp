#include "lib/records/record_format.hpp"

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

}  // namespace

std::vector<std::unique_ptr<RecordRows>> read_records(const RecordFile& file, const ReadOptions& options) {
  std::vector<std::unique_ptr<RecordRows>> records;
  records.push_back(read_text_record(file, dialect(options.format), options.text, options.sampling));
  return records;
}

}  // namespace impulse
