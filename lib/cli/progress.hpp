#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace impulse {

/// How far long work has come, `ir-impact: 43 %`, on one line that rewrites itself and is wiped away at the end.
///
/// Silent unless the stream is a terminal, and until the work has taken `patience`; then at most five times a second.
/// Verified by: tests/lib/progress.test.cpp
class Progress {
 public:
  explicit Progress(std::string name, std::FILE* stream = stderr,
                    std::chrono::milliseconds patience = std::chrono::seconds(2));
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// `done` of the work, 0 to 1.
  void operator()(double done);

 private:
  using Clock = std::chrono::steady_clock;
  std::string name_;
  std::FILE* stream_;  ///< null if it is no terminal
  Clock::time_point next_;
  bool shown_ = false;
};

/// Whether messages on stderr are read by a person rather than kept by a script.
[[nodiscard]] bool stderr_is_terminal();

}  // namespace impulse
