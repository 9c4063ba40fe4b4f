#pragma once

#include <cstddef>
#include <string>

namespace impulse {

/// A file to be read once, front to back; `-` is stdin. Errors are InputErrors that say why.
class InputFile {
 public:
  explicit InputFile(const std::string& path);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  /// What messages call it: the path, or `stdin`.
  [[nodiscard]] const std::string& name() const { return name_; }

  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// Fills at most `size` characters; returns their number, 0 at the end.
  std::size_t read(char* buffer, std::size_t size);

 private:
  std::string name_;
  int descriptor_;
};

/// The whole file as text.
[[nodiscard]] std::string read_text(const std::string& path);

}  // namespace impulse
