#include "lib/records/universal_file.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace impulse;
  for (const Incomplete incomplete : {Incomplete::refuse, Incomplete::take})
    fuzz::convert(data, size, [&](const RecordFile& file) {
      return fuzz::rows_of(read_universal_file(file, {incomplete, {}}));
    });
  return 0;
}
