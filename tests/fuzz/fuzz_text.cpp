#include "lib/records/text_record.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace impulse;
  return fuzz::convert(data, size, [](const RecordFile& file) {
    std::vector<std::unique_ptr<RecordRows>> records;
    records.push_back(read_text_record(file, TextDialect::any, {}, {}));
    return records;
  });
}
