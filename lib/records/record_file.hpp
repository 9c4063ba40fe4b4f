#pragma once

#include "lib/csv/input_file.hpp"

#include <cstdint>
#include <string>

namespace impulse {

/// The bytes of a record, to be read as often and in any order as its format wants: the file itself, or a temporary
/// copy (in $TMPDIR, without a name, gone when the program ends) of what a pipe delivers. `-` is stdin.
class RecordFile {
 public:
  /// @throws InputError saying why it cannot be read; OutputError if the copy cannot be written.
  explicit RecordFile(const std::string& path);
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;
  ~RecordFile();

  [[nodiscard]] const std::string& name() const { return input_.name(); }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] int descriptor() const { return copy_ >= 0 ? copy_ : input_.descriptor(); }

  /// A path under which libraries may open it.
  [[nodiscard]] std::string path() const;

  /// Fills at most `size` characters from `offset` on; returns their number, 0 at the end.
  std::size_t read_at(std::uint64_t offset, char* buffer, std::size_t size) const;

  /// The first `most` bytes, or all there are.
  [[nodiscard]] std::string head(std::size_t most) const;

 private:
  void copy();

  InputFile input_;
  int copy_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace impulse
