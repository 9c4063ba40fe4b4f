#include "lib/records/record_file.hpp"

#include "lib/contract/errors.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace impulse {

RecordFile::RecordFile(const std::string& path) : input_(path) {
  struct stat status {};
  // A redirected stdin may have been read in part: what is left of it is the record.
  const bool seekable = ::fstat(input_.descriptor(), &status) == 0 && S_ISREG(status.st_mode) &&
                        ::lseek(input_.descriptor(), 0, SEEK_CUR) == 0;
  if (seekable)
    size_ = static_cast<std::uint64_t>(status.st_size);
  else
    copy();
}

RecordFile::~RecordFile() {
  if (copy_ >= 0) ::close(copy_);
}

void RecordFile::copy() {
  const char* folder = std::getenv("TMPDIR");
  std::string name = std::string(folder && *folder ? folder : "/tmp") + "/record-XXXXXX";
  const auto fail = [&] {
    throw OutputError(fmt::format("cannot copy {} to {}: {}", input_.name(), name, std::strerror(errno)));
  };
  copy_ = ::mkstemp(name.data());
  if (copy_ < 0) fail();
  ::unlink(name.c_str());
  std::array<char, 1 << 17> buffer;
  while (const std::size_t count = input_.read(buffer.data(), buffer.size())) {
    for (std::size_t written = 0; written < count;) {
      const ssize_t now = ::write(copy_, buffer.data() + written, count - written);
      if (now < 0 && errno != EINTR) fail();
      if (now > 0) written += static_cast<std::size_t>(now);
    }
    size_ += count;
  }
}

std::string RecordFile::path() const { return fmt::format("/proc/self/fd/{}", descriptor()); }

std::size_t RecordFile::read_at(std::uint64_t offset, char* buffer, std::size_t size) const {
  while (true) {
    const ssize_t count = ::pread(descriptor(), buffer, size, static_cast<off_t>(offset));
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR) throw InputError(name(), 0, 0, std::strerror(errno));
  }
}

std::string RecordFile::head(std::size_t most) const {
  std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(most, size_)), '\0');
  std::size_t filled = 0;
  while (filled < text.size()) {
    const std::size_t count = read_at(filled, text.data() + filled, text.size() - filled);
    if (count == 0) break;
    filled += count;
  }
  text.resize(filled);
  return text;
}

}  // namespace impulse
