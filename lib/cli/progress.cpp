#include "lib/cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

namespace impulse {

Progress::Progress(std::string name, std::FILE* stream, std::chrono::milliseconds patience)
    : name_(std::move(name)),
      stream_(::isatty(::fileno(stream)) != 0 ? stream : nullptr),
      next_(Clock::now() + patience) {}

Progress::~Progress() {
  if (!shown_) return;
  std::fputs("\r\x1b[K", stream_);
  std::fflush(stream_);
}

void Progress::operator()(double done) {
  if (stream_ == nullptr) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(200);
  shown_ = true;
  fmt::print(stream_, "\r{}: {:.0f} %\x1b[K", name_, 100 * done);
  std::fflush(stream_);
}

bool stderr_is_terminal() { return ::isatty(STDERR_FILENO) != 0; }

}  // namespace impulse
