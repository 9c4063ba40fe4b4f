#include "lib/cli/run_tool.hpp"

#include "lib/contract/errors.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>

namespace impulse {
namespace {

/// A message may quote what was read, binary garbage or a line of megabytes: it stays one line of at most 1000
/// characters.
std::string one_line(std::string message) {
  constexpr std::size_t most = 1000, ending = 300;
  if (message.size() > most) {
    const auto inside_character = [&](std::size_t at) {
      return (static_cast<unsigned char>(message[at]) & 0xC0) == 0x80;
    };
    std::size_t begin = most - ending;
    while (begin > 0 && inside_character(begin)) --begin;
    std::size_t end = message.size() - ending;
    while (end < message.size() && inside_character(end)) ++end;
    message = message.substr(0, begin) + " ... " + message.substr(end);
  }
  for (char& c : message)
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7F) c = '?';
  return message;
}

void flush_stdout() {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return;
  if (errno == EPIPE) throw ClosedPipe();
  throw OutputError(fmt::format("cannot write stdout: {}", std::strerror(errno)));
}

}  // namespace

int run_tool(int argc, char** argv, Command& command, const std::function<int()>& body) {
  const auto report = [&](const char* message, int code) {
    fmt::print(stderr, "{}: {}\n", command.page().name, one_line(message));
    return code;
  };
  // A write to a closed pipe then fails with EPIPE, which becomes ClosedPipe, and temporary files are removed.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    if (!command.parse(argc, argv)) return 0;
    const int code = body();
    flush_stdout();
    return code;
  } catch (const ClosedPipe&) {
    return 0;
  } catch (const UsageError& error) {
    return report(error.what(), 2);
  } catch (const InputError& error) {
    return report(error.what(), 2);
  } catch (const std::invalid_argument& error) {
    return report(error.what(), 2);
  } catch (const std::bad_alloc&) {
    return report("out of memory", 1);
  } catch (const std::exception& error) {
    return report(error.what(), 1);
  }
}

}  // namespace impulse
