#include "lib/csv/output_file.hpp"

#include "lib/contract/errors.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace impulse {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 16;

bool is_stdout(const std::string& path) { return path.empty() || path == "-" || path == "/dev/stdout"; }

/// Renaming over /dev/fd/3 or a FIFO would replace it instead of writing to it.
bool is_written_directly(const std::string& path) {
  struct stat status {};
  if (path.starts_with("/dev/") || path.starts_with("/proc/")) return true;
  return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

std::string followed(const std::string& path) {
  std::error_code error;
  const std::filesystem::path target = std::filesystem::canonical(path, error);
  return error ? path : target.string();
}

[[noreturn]] void fail_to_write(const std::string& name, int error) {
  throw OutputError(fmt::format("cannot write {}: {}", name, std::strerror(error)));
}

}  // namespace

void require_writable(const std::string& path) {
  if (is_stdout(path)) return;
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) fail_to_write(path, EISDIR);
  if (is_written_directly(path)) {
    if (::access(path.c_str(), W_OK) != 0) fail_to_write(path, errno);
    return;
  }
  const std::filesystem::path folder = std::filesystem::path(followed(path)).parent_path();
  const std::string name = folder.empty() ? "." : folder.string();
  if (::stat(name.c_str(), &status) != 0) fail_to_write(path, errno);
  if (!S_ISDIR(status.st_mode)) fail_to_write(path, ENOTDIR);
  if (::access(name.c_str(), W_OK | X_OK) != 0) fail_to_write(path, errno);
}

OutputFile::OutputFile(const std::string& path) : path_(is_stdout(path) ? "stdout" : path), target_(path_) {
  buffer_.reserve(buffer_size);
  if (is_stdout(path)) {
    descriptor_ = STDOUT_FILENO;
    return;
  }
  int flags = O_WRONLY | O_CLOEXEC;
  std::string name = path;
  if (!is_written_directly(path)) {
    target_ = followed(path);
    temporary_ = fmt::format("{}.{}.tmp", target_, ::getpid());
    name = temporary_;
    flags |= O_CREAT | O_TRUNC;
  }
  descriptor_ = ::open(name.c_str(), flags, 0666);
  if (descriptor_ < 0) {
    const int error = errno;
    temporary_.clear();
    fail(error);
  }
}

OutputFile::~OutputFile() {
  if (descriptor_ > STDOUT_FILENO) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::write(std::string_view text) {
  if (buffer_.size() + text.size() > buffer_size) {
    write_out(buffer_);
    buffer_.clear();
  }
  if (text.size() > buffer_size)
    write_out(text);
  else
    buffer_ += text;
}

void OutputFile::write_out(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor_, text.data(), text.size());
    if (count >= 0) {
      text.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EPIPE) {
      throw ClosedPipe();
    } else if (errno != EINTR) {
      fail(errno);
    }
  }
}

void OutputFile::close() {
  if (descriptor_ < 0) return;
  write_out(buffer_);
  buffer_.clear();
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (descriptor > STDOUT_FILENO && ::close(descriptor) != 0) fail(errno);
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void OutputFile::fail(int error) const { fail_to_write(path_, error); }

void write_text(const std::string& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.close();
}

}  // namespace impulse
