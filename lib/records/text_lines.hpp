#pragma once

#include "lib/records/record_file.hpp"

#include <string_view>
#include <vector>

namespace impulse {

/// A place between two lines.
struct TextPlace {
  std::uint64_t offset = 0;  ///< bytes before it
  std::size_t lines = 0;     ///< lines before it
};

/// The lines of a text one by one, in the memory of one line (or 1 MiB), whatever ends them: LF, CRLF, or CR alone.
class TextLines {
 public:
  explicit TextLines(const RecordFile& file, const TextPlace& from = {});

  /// The next line without its end; false after the last. It is valid until the next call.
  /// @throws InputError if a line is longer than 64 MiB.
  [[nodiscard]] bool next(std::string_view& line);

  /// Number of the line that next() gave, from 1.
  [[nodiscard]] std::size_t number() const { return number_; }

  /// Where the next line begins.
  [[nodiscard]] TextPlace place() const { return {offset_ - (end_ - begin_), number_}; }

 private:
  void refill();

  const RecordFile& file_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< what of the buffer has not been given yet
  std::uint64_t offset_ = 0;         ///< of the file, behind the buffer
  std::size_t number_ = 0;
  char terminator_ = '\n';
};

}  // namespace impulse
