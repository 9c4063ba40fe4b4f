#include "lib/csv/input_file.hpp"

#include "lib/contract/errors.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace impulse {

InputFile::InputFile(const std::string& path)
    : name_(path == "-" ? "stdin" : path),
      descriptor_(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (path.empty()) throw InputError("''", 0, 0, "the name of the file is empty");
  if (descriptor_ < 0) throw InputError(name_, 0, 0, std::strerror(errno));
}

InputFile::~InputFile() {
  if (descriptor_ != STDIN_FILENO) ::close(descriptor_);
}

std::size_t InputFile::read(char* buffer, std::size_t size) {
  while (true) {
    const ssize_t count = ::read(descriptor_, buffer, size);
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR) throw InputError(name_, 0, 0, std::strerror(errno));
  }
}

std::string read_text(const std::string& path) {
  InputFile file(path);
  std::array<char, 65536> buffer;
  std::string text;
  while (const std::size_t count = file.read(buffer.data(), buffer.size())) text.append(buffer.data(), count);
  return text;
}

}  // namespace impulse
