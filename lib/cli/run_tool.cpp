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

void flush_stdout() {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return;
  if (errno == EPIPE) throw ClosedPipe();
  throw OutputError(fmt::format("cannot write stdout: {}", std::strerror(errno)));
}

}  // namespace

int run_tool(int argc, char** argv, Command& command, const std::function<int()>& body) {
  const auto report = [&](const char* message, int code) {
    fmt::print(stderr, "{}: {}\n", command.page().name, message);
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
