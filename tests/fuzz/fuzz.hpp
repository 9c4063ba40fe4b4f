#pragma once

#include "lib/contract/errors.hpp"
#include "lib/records/record_conversion.hpp"
#include "lib/records/record_csv.hpp"
#include "lib/records/record_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace impulse::fuzz {

/// The input as a file without a name.
class InputBytes {
 public:
  InputBytes(const std::uint8_t* data, std::size_t size) : descriptor_(::memfd_create("input", 0)) {
    for (std::size_t written = 0; written < size;) {
      const ssize_t count = ::write(descriptor_, data + written, size - written);
      if (count <= 0) break;
      written += static_cast<std::size_t>(count);
    }
  }
  InputBytes(const InputBytes&) = delete;
  InputBytes& operator=(const InputBytes&) = delete;
  ~InputBytes() { ::close(descriptor_); }
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

/// Converts what `read` makes of the input, as the tool does; wrong input is what it may refuse, and nothing else may
/// happen.
template <class Read>
int convert(const std::uint8_t* data, std::size_t size, const Read& read) {
  const InputBytes input(data, size);
  try {
    const RecordFile file(input.path());
    for (std::unique_ptr<RecordRows>& record : read(file)) {
      const std::unique_ptr<RecordRows> rows = converted_record(std::move(record), {});
      (void)record_columns(rows->header());
      std::vector<double> row(rows->width());
      while (rows->next(row)) {
      }
    }
  } catch (const InputError&) {
  } catch (const UsageError&) {
  } catch (const std::invalid_argument&) {
  }
  return 0;
}

/// Records in memory, as rows.
inline std::vector<std::unique_ptr<RecordRows>> rows_of(std::vector<Record> records) {
  std::vector<std::unique_ptr<RecordRows>> rows;
  for (Record& record : records) rows.push_back(record_rows(std::move(record)));
  return rows;
}

}  // namespace impulse::fuzz
