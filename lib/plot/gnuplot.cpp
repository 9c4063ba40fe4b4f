#include "lib/plot/gnuplot.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace impulse {
namespace {

struct FileClose {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using TemporaryFile = std::unique_ptr<std::FILE, FileClose>;

TemporaryFile temporary_file() {
  TemporaryFile file(std::tmpfile());
  if (!file) throw std::runtime_error(fmt::format("cannot make a temporary file: {}", std::strerror(errno)));
  return file;
}

std::string contents(std::FILE* file) {
  std::string text;
  std::array<char, 65536> buffer;
  std::rewind(file);
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file)) text.append(buffer.data(), count);
  return text;
}

/// Starts gnuplot with the three standard streams on files, which no amount of output can block.
int exit_status_of_gnuplot(std::FILE* in, std::FILE* out, std::FILE* err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(in), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(out), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(err), STDERR_FILENO);
  std::array<char*, 3> arguments{const_cast<char*>("gnuplot"), const_cast<char*>("-d"), nullptr};
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) throw std::runtime_error("gnuplot is not installed (pictures are drawn by it); install gnuplot");
  if (error != 0) throw std::runtime_error(fmt::format("cannot run gnuplot: {}", std::strerror(error)));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw std::runtime_error(fmt::format("cannot wait for gnuplot: {}", std::strerror(errno)));
  return status;
}

/// The last line that says something: gnuplot shows the command and a caret before it. Its `line 0:` is of no use here.
std::string last_message(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \n");
  if (end == text.npos) return "no message";
  std::string line = text.substr(0, end + 1);
  line.erase(0, line.rfind('\n') + 1);
  line.erase(0, line.find_first_not_of(' '));
  if (line.starts_with("line ") && line.find(": ") != line.npos) line.erase(0, line.find(": ") + 2);
  return line;
}

/// Puts an epoch in the place of the date of creation, of the same length because the file holds offsets.
void fix_pdf_date(std::string& output) {
  const std::string_view key = "/CreationDate (D:";
  const std::size_t found = output.starts_with("%PDF") ? output.find(key) : output.npos;
  if (found == output.npos) return;
  const std::string_view epoch = "19700101000000";
  if (output.size() >= found + key.size() + epoch.size()) output.replace(found + key.size(), epoch.size(), epoch);
}

}  // namespace

std::string gnuplot_output(const std::string& script) {
  const TemporaryFile in = temporary_file(), out = temporary_file(), err = temporary_file();
  if (std::fwrite(script.data(), 1, script.size(), in.get()) != script.size() || std::fflush(in.get()) != 0)
    throw std::runtime_error(fmt::format("cannot write a temporary file: {}", std::strerror(errno)));
  std::rewind(in.get());
  const int status = exit_status_of_gnuplot(in.get(), out.get(), err.get());
  std::string output = contents(out.get());
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || output.empty())
    throw std::runtime_error(fmt::format("gnuplot failed: {}", last_message(contents(err.get()))));
  if (output.starts_with('\f')) output.erase(0, 1);  // the dumb terminal clears the screen
  fix_pdf_date(output);
  return output;
}

}  // namespace impulse
