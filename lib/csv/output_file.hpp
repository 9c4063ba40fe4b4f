#pragma once

#include <string>
#include <string_view>

namespace impulse {

/// Where a result goes: "" or `-` is stdout. A regular file, new or existing, is written under a temporary name beside
/// it and takes its own name in close(); an object destroyed without close() leaves nothing behind and the old file
/// untouched. A device or FIFO, and what lies under /dev or /proc, is written directly.
/// Verified by: tests/lib/csv_output.test.cpp
class OutputFile {
 public:
  /// @throws OutputError saying why it cannot be written.
  explicit OutputFile(const std::string& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// @throws ClosedPipe if nobody reads any more, OutputError for any other reason.
  void write(std::string_view text);

  /// Makes the file appear. @throws OutputError
  void close();

 private:
  void write_out(std::string_view text);
  [[noreturn]] void fail(int error) const;

  std::string path_;       ///< as the user named it
  std::string target_;     ///< with symbolic links followed
  std::string temporary_;  ///< empty if written directly
  std::string buffer_;
  int descriptor_ = -1;
};

/// Whether an OutputFile of this path could be opened now; nothing is created, so that what is dear to compute can be
/// refused beforehand.
/// @throws OutputError saying why it could not.
void require_writable(const std::string& path);

/// Writes one text as a whole. @throws as OutputFile.
void write_text(const std::string& path, std::string_view text);

}  // namespace impulse
