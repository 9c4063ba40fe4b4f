#include "lib/cli/progress.hpp"

#include <doctest/doctest.h>

#include <pty.h>
#include <unistd.h>

#include <cstdio>
#include <string>

using namespace impulse;
using namespace std::chrono_literals;

namespace {

/// What arrives at the other end of a stream, once `act` has written to it.
template <class Action>
std::string written(int reader, int writer, Action act) {
  std::FILE* stream = ::fdopen(writer, "w");
  act(stream);
  // A terminal hands on when it likes: read until a last sign has come, however many pieces that takes.
  std::fputc('\a', stream);
  std::fflush(stream);
  std::string text;
  for (char piece[256]; text.empty() || text.back() != '\a';) {
    const ssize_t count = ::read(reader, piece, sizeof piece);
    REQUIRE(count > 0);
    text.append(piece, static_cast<std::size_t>(count));
  }
  text.pop_back();
  std::fclose(stream);
  ::close(reader);
  return text;
}

template <class Action>
std::string on_terminal(Action act) {
  int reader = 0, writer = 0;
  REQUIRE(::openpty(&reader, &writer, nullptr, nullptr, nullptr) == 0);
  return written(reader, writer, act);
}

template <class Action>
std::string on_pipe(Action act) {
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  return written(ends[0], ends[1], act);
}

}  // namespace

TEST_CASE("progress: on a terminal one line, at most five times a second, wiped away at the end") {
  const std::string text = on_terminal([](std::FILE* stream) {
    Progress progress("ir-test", stream, 0ms);
    progress(0.427);
    progress(0.9);  // too soon after the last
  });
  CHECK(text == "\rir-test: 43 %\x1b[K\r\x1b[K");
}

TEST_CASE("progress: silent before its patience ends, and on what is no terminal") {
  CHECK(on_terminal([](std::FILE* stream) { Progress("ir-test", stream)(0.5); }).empty());
  CHECK(on_pipe([](std::FILE* stream) { Progress("ir-test", stream, 0ms)(0.5); }).empty());
}
