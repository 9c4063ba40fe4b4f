#include "lib/csv/csv_output.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/csv_table.hpp"
#include "tests/support/temporary_directory.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

using namespace impulse;
using impulse::test::TemporaryDirectory;

TEST_CASE("write_csv writes the shortest digits that read back the same") {
  const TemporaryDirectory directory;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> exponent(-300, 300);
  std::vector<double> values{
      0, -0.0, 1, 0.1, 1e-6, 1e20, std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max()};
  while (values.size() < 1000) values.push_back(std::pow(10.0, exponent(random)));
  std::vector<double> index(values.size());
  for (std::size_t k = 0; k < index.size(); ++k) index[k] = static_cast<double>(k);
  write_csv(directory / "a.csv", {{"index", index}, {"value", values}});
  CHECK(directory.read("a.csv").starts_with("index,value\n0,0\n1,-0\n2,1\n3,0.1\n4,1e-06\n5,1e+20\n"));
  const CsvTable table = read_csv(directory / "a.csv");
  CHECK(table.column("value") == values);
  CHECK(table.column("index") == index);
  CHECK(directory.file_count() == 1);
}

TEST_CASE("write_csv refuses before it writes") {
  const TemporaryDirectory directory;
  const std::vector<double> two{1, 2}, three{1, 2, 3}, bad{1, std::nan("")};
  CHECK_THROWS_WITH_AS(write_csv(directory / "a.csv", {{"x", two}, {"y", three}}),
                       "column y has 3 values, column x has 2", std::invalid_argument);
  CHECK_THROWS_WITH_AS(write_csv(directory / "a.csv", {{"x", bad}}), "column x is not written: a value is nan",
                       OutputError);
  CHECK_THROWS_AS(write_csv(directory / "a.csv", {}), std::invalid_argument);
  CHECK(directory.file_count() == 0);
}

TEST_CASE("CsvOutput quotes what needs it and reads back the same") {
  const TemporaryDirectory directory;
  const std::vector<std::string> texts{"plain.csv", "a,b", "say \"no\"", " blank", "# note", "two\nlines"};
  CsvOutput output(directory / "a.csv", {"file", "value", "maybe"});
  for (const std::string& text : texts) output.row({text, 1.5, std::optional<double>()});
  CHECK_THROWS_AS(output.row({std::string("x")}), std::invalid_argument);
  CHECK_THROWS_AS(output.row({std::string("x"), std::nan(""), {}}), OutputError);
  output.close();
  CHECK(
      directory.read("a.csv").starts_with("file,value,maybe\nplain.csv,1.5,\n\"a,b\",1.5,\n\"say \"\"no\"\"\",1.5,\n"));
  const CsvTable table = read_csv(directory / "a.csv");
  REQUIRE(table.row_count() == texts.size());
  CHECK(table.text("file", 1) == "a,b");
  CHECK(table.text("file", 2) == texts[2]);
  CHECK(table.text("file", 4) == texts[4]);
  CHECK(table.text("file", 5) == texts[5]);
}

TEST_CASE("OutputFile: a file appears as a whole or not at all") {
  const TemporaryDirectory directory;
  const std::string old = directory.write("a.txt", "old");
  {
    OutputFile file(old);
    file.write(std::string(200000, 'x'));
    CHECK(directory.read("a.txt") == "old");
    CHECK(directory.file_count() == 2);
  }
  CHECK(directory.read("a.txt") == "old");
  CHECK(directory.file_count() == 1);
  {
    OutputFile file(old);
    file.write("new");
    file.close();
  }
  CHECK(directory.read("a.txt") == "new");
  CHECK(directory.file_count() == 1);
}

TEST_CASE("OutputFile: new files have the permissions of the umask") {
  const TemporaryDirectory directory;
  const mode_t before = ::umask(027);
  write_text(directory / "a.txt", "x");
  ::umask(before);
  struct stat status {};
  REQUIRE(::stat((directory / "a.txt").c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0640);
}

TEST_CASE("OutputFile writes through a symbolic link") {
  const TemporaryDirectory directory;
  const std::string target = directory.write("target.txt", "old");
  std::filesystem::create_symlink(target, directory / "link.txt");
  write_text(directory / "link.txt", "new");
  CHECK(std::filesystem::is_symlink(directory / "link.txt"));
  CHECK(directory.read("target.txt") == "new");
}

TEST_CASE("OutputFile says why it cannot write") {
  const TemporaryDirectory directory;
  CHECK_THROWS_WITH_AS(write_text("/dev/full", "x"), "cannot write /dev/full: No space left on device", OutputError);
  CHECK_THROWS_WITH_AS(write_text("/nowhere/a.csv", "x"), "cannot write /nowhere/a.csv: No such file or directory",
                       OutputError);
  CHECK_THROWS_WITH_AS(write_text(directory / ".", "x"), doctest::Contains("Is a directory"), OutputError);
  CHECK_NOTHROW(write_text("/dev/null", "x"));
}

TEST_CASE("OutputFile tells a closed pipe from other failures") {
  const TemporaryDirectory directory;
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  const std::string fifo = directory / "fifo";
  REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
  const int reader = ::open(fifo.c_str(), O_RDONLY | O_NONBLOCK);
  REQUIRE(reader >= 0);
  OutputFile file(fifo);
  file.write("x");
  ::close(reader);
  CHECK_THROWS_AS(file.close(), ClosedPipe);
  CHECK(std::filesystem::is_fifo(fifo));
  std::signal(SIGPIPE, before);
}
