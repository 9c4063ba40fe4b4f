#include "lib/records/mat_file.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace impulse;
  return fuzz::convert(data, size, [](const RecordFile& file) { return fuzz::rows_of(read_mat_file(file, {})); });
}
