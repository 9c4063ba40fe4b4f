#include "lib/records/text_record.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace impulse;
  return fuzz::convert(data, size, [](const RecordFile& file) {
    return read_text_records(file, TextDialect::any, {}, {});
  });
}
