#include "lib/plot/gnuplot.hpp"

#include "lib/contract/require.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <memory>
#include <stdexcept>

namespace impulse {
namespace {

/// A gnuplot string; within single quotes nothing but the quote itself is special.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    result += c == '\n' ? ' ' : c;
  }
  return result + "'";
}

const char* terminal(PictureFormat format) {
  switch (format) {
    case PictureFormat::svg:
      return "svg size 900,500 noenhanced font 'sans,14' rounded background 'white'";
    case PictureFormat::png:
      return "pngcairo size 900,500 noenhanced font 'sans,12' rounded background 'white'";
    case PictureFormat::pdf:
      return "pdfcairo size 9in,5in noenhanced font 'sans,14' rounded";
    case PictureFormat::text:
      break;
  }
  return "dumb size 79,24 noenhanced";
}

/// A palette that colour-blind readers can tell apart [Wong2011]; dashes begin when it is used up.
std::string line_style(std::size_t index) {
  static constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
  return fmt::format("lw 1.8 lc rgb '{}' dt {}", colours[index % colours.size()], 1 + index / colours.size());
}

bool x_has_extent(const Picture& picture) {
  const double first = picture.curves.front().x.front();
  for (const Curve& curve : picture.curves)
    if (std::any_of(curve.x.begin(), curve.x.end(), [&](double x) { return x != first; })) return true;
  return false;
}

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

std::string gnuplot_script(const Picture& picture, PictureFormat format) {
  require(!picture.curves.empty(), "a picture needs at least one curve");
  std::string script;
  auto out = std::back_inserter(script);
  fmt::format_to(out, "set encoding utf8\nset terminal {}\n", terminal(format));
  for (std::size_t i = 0; i < picture.curves.size(); ++i) {
    const Curve& curve = picture.curves[i];
    require(curve.x.size() == curve.y.size() && curve.x.size() >= 2,
            "curve {} has {} by {} points; it needs two or more", i + 1, curve.x.size(), curve.y.size());
    fmt::format_to(out, "$curve{} << END\n", i);
    for (std::size_t k = 0; k < curve.x.size(); ++k) fmt::format_to(out, "{:.8g} {:.8g}\n", curve.x[k], curve.y[k]);
    script += "END\n";
  }
  // The dumb terminal has no room for a label of the vertical axis.
  const std::string title = format != PictureFormat::text ? picture.title
                            : picture.title.empty()       ? picture.y_label
                                                          : picture.title + ": " + picture.y_label;
  if (!title.empty()) fmt::format_to(out, "set title {}\n", quoted(title));
  fmt::format_to(out, "set xlabel {}\n", quoted(picture.x_label));
  if (format != PictureFormat::text) fmt::format_to(out, "set ylabel {}\n", quoted(picture.y_label));
  if (format != PictureFormat::text)
    script +=
        "set rmargin 4\nset border 3 lc rgb '#404040'\nset tics nomirror\nset grid lt 1 lc rgb '#d8d8d8' lw 0.8\n"
        "set xzeroaxis lt 1 lc rgb '#808080' lw 0.8\n";
  if (x_has_extent(picture)) script += "set autoscale xfix\n";
  script += "set offsets 0, 0, graph 0.05, graph 0.05\n";
  // Above the axes: nowhere else is it sure not to cover a curve.
  script += picture.curves.size() > 1 ? "set key tmargin center horizontal reverse Left samplen 3\n" : "set key off\n";
  for (std::size_t i = 0; i < picture.curves.size(); ++i)
    fmt::format_to(out, "{} $curve{} using 1:2 with lines {} title {}", i == 0 ? "plot" : ", \\\n    ", i,
                   format == PictureFormat::text ? "" : line_style(i), quoted(picture.curves[i].label));
  return script + "\n";
}

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
