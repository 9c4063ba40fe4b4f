#include "lib/csv/csv_table.hpp"
#include "lib/contract/errors.hpp"
#include "lib/csv/decimal.hpp"
#include "tests/support/about.hpp"
#include "tests/support/temporary_directory.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

using namespace impulse;
using impulse::test::TemporaryDirectory;

namespace {

/// what() of the error without the directory of the file, which is called a.csv.
template <class Action>
std::string message_of(const std::string& text, Action action) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("a.csv", text);
  try {
    action(read_csv(path));
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find("a.csv"));
  }
  return "no error";
}

std::string refusal(const std::string& text) {
  return message_of(text, [](const CsvTable&) {});
}
std::string column_refusal(const std::string& text) {
  return message_of(text, [](const CsvTable& table) { (void)table.column("x"); });
}
std::string time_refusal(const std::string& text) {
  return message_of(text, [](const CsvTable& table) { (void)uniform_time(table); });
}

CsvTable table_of(const std::string& text) {
  const TemporaryDirectory directory;
  return read_csv(directory.write("a.csv", text));
}

}  // namespace

TEST_CASE("leading_decimal reads what a spreadsheet writes and nothing else") {
  CHECK(leading_decimal("1.5mm").value == 1.5);
  CHECK(leading_decimal("1.5mm").length == 3);
  CHECK(leading_decimal("+2e3").value == 2000);
  CHECK(leading_decimal("+2e3").length == 4);
  CHECK(leading_decimal("-.5").value == -0.5);
  CHECK(leading_decimal("1e-999").value == 0);
  CHECK(std::isinf(leading_decimal("1e999").value));
  for (const char* text : {"", "+", "-", "+-1", "--1", "inf", "-inf", "nan", "NaN", "e5", " 1"}) {
    CAPTURE(text);
    CHECK(leading_decimal(text).length == 0);
  }
}

TEST_CASE("read_csv finds columns by name") {
  const CsvTable table = table_of("time_s, force_N ,note\n0,1.5,ok\n1e-6,-2,\"so, so\"\n");
  CHECK(table.names() == std::vector<std::string>{"time_s", "force_N", "note"});
  CHECK(table.row_count() == 2);
  CHECK(table.has("force_N"));
  CHECK_FALSE(table.has("force"));
  CHECK(table.column("force_N") == std::vector<double>{1.5, -2});
  CHECK(&table.column("force_N") == &table.column("force_N"));
  CHECK(table.text("note", 1) == "so, so");
  CHECK(table.text("time_s", 1) == "1e-6");
  CHECK(table.field("note") == 3);
}

TEST_CASE("read_csv tolerates what files have in practice") {
  const std::string plain = "x,y\n1,2\n3,4\n";
  for (const std::string& text : std::initializer_list<std::string>{
           "\xEF\xBB\xBFx,y\n1,2\n3,4\n", "x,y\r\n1,2\r\n3,4\r\n", "# made by\n\nx,y\n# c\n1,2\n\n \n3,4\n# end",
           "x,y\n1,2\n3,4", " x ,\ty\n 1 , 2\n\"3\",\" 4 \"\n", "\xEF\xBB\xBF# c\nx,y\n1,2\n#,\",\n3,4\n"}) {
    CAPTURE(text);
    const CsvTable table = table_of(text);
    CHECK(table.names() == table_of(plain).names());
    CHECK(table.column("x") == std::vector<double>{1, 3});
    CHECK(table.column("y") == std::vector<double>{2, 4});
  }
}

TEST_CASE("read_csv knows the line of every row") {
  const CsvTable table = table_of("# c\nx,t\n1,a\n\n# c\n2,\"two\n# no comment\nlines\"\n3,b\n");
  REQUIRE(table.row_count() == 3);
  CHECK(table.line(0) == 3);
  CHECK(table.line(1) == 6);
  CHECK(table.line(2) == 9);
  CHECK(table.text("t", 1) == "two\n# no comment\nlines");
}

TEST_CASE("read_csv gives the same answer across its blocks") {
  std::string text = "x,y\n";
  for (int k = 0; k < 60000; ++k) text += fmt::format("{},{}\n#{:>8}\n", k, 0.1 * k, k);
  const CsvTable table = table_of(text);
  REQUIRE(table.row_count() == 60000);
  for (std::size_t k = 0; k < 60000; ++k) {
    REQUIRE(table.column("y")[k] == 0.1 * static_cast<double>(k));
    REQUIRE(table.line(k) == 2 * k + 2);
  }
}

TEST_CASE("read_csv refuses with file:line:column") {
  CHECK(refusal("") == "a.csv: empty (expected a header line and rows)");
  CHECK(refusal("# only\n\n") == "a.csv: empty (expected a header line and rows)");
  CHECK(refusal("x,y\n") == "a.csv: has a header but no rows");
  CHECK(refusal("x,y,x\n1,2,3\n") == "a.csv:1:3: two columns are called 'x'");
  CHECK(refusal("x,y\n1,2\n3\n") == "a.csv:3:2: the row has 1 field, the header 2");
  CHECK(refusal("x,y\n1,2,3\n") == "a.csv:2:3: the row has 3 fields, the header 2");
  CHECK(refusal("x,y\n1,a\"b\n") == "a.csv:2:2: misplaced quote");
  CHECK(refusal("x,y\n1,\"a\n2,3\n") == "a.csv:2: a quote is left open");
  CHECK_THROWS_WITH_AS((void)read_csv("/nowhere/a.csv"), "/nowhere/a.csv: No such file or directory", InputError);
  CHECK_THROWS_WITH_AS((void)read_csv("/"), "/: Is a directory", InputError);
}

TEST_CASE("column refuses fields that are no finite numbers, but only when asked for") {
  CHECK(column_refusal("x,y\n1,2\nabc,4\n") == "a.csv:3:1: 'abc' in column 'x' is not a finite number");
  CHECK(column_refusal("y,x\n1,2\n4,\n") == "a.csv:3:2: empty field in column 'x'");
  CHECK(column_refusal("x\nNaN\n") == "a.csv:2:1: 'NaN' in column 'x' is not a finite number");
  CHECK(column_refusal("x\n-inf\n") == "a.csv:2:1: '-inf' in column 'x' is not a finite number");
  CHECK(column_refusal("x\n1e999\n") == "a.csv:2:1: '1e999' in column 'x' is too large for a number");
  CHECK(column_refusal("x;y\n1,5;2\n").starts_with("a.csv:2:2: the row has 2 fields"));
  CHECK(column_refusal("y,z\n1,2\n") == "a.csv: no column 'x' (there are: y, z)");
  CHECK(refusal("x,y\nabc,\n") == "no error");
}

TEST_CASE("uniform_time takes the step from both ends") {
  CHECK(uniform_time(table_of("time_s\n0\n0.5\n1.0\n1.5\n")) == UniformGrid{0.5, 4});
  std::string text = "time_s\n";
  double time = 0;
  for (int k = 0; k < 20000; ++k, time += 1e-7) text += fmt::format("{}\n", time);
  const UniformGrid grid = uniform_time(table_of(text));
  CHECK(grid.size == 20000);
  CHECK(grid.step_s == about(1e-7).epsilon(1e-10));
  CHECK(uniform_time(table_of("time_s\n0\n1\n2.0000009\n")).size == 3);
}

TEST_CASE("uniform_time refuses at the offending line") {
  CHECK(time_refusal("x\n1\n") == "a.csv: no column 'time_s' (there are: x)");
  CHECK(time_refusal("time_s\n0\n") == "a.csv:2:1: one sample only (a record needs at least two)");
  CHECK(time_refusal("x,time_s\n1,0\n1,1\n1,2\n1,4\n1,5\n") ==
        "a.csv:5:2: time 4 s follows 2 s: the step is not uniform");
  CHECK(time_refusal("time_s\n0\n1\n2.00001\n") == "a.csv:3:1: time 1 s follows 0 s: the step is not uniform");
  CHECK(time_refusal("time_s\n0\n0\n0\n") == "a.csv:3:1: time 0 s follows 0 s: the step is not uniform");
  CHECK(time_refusal("time_s\n2\n1\n0\n") == "a.csv:3:1: time 1 s follows 2 s: the step is not uniform");
  CHECK(time_refusal("time_s\n1\n2\n3\n") ==
        "a.csv:2:1: time begins at 1 s (it must begin at 0; ir-convert --zero-time makes it)");
}

TEST_CASE("uniform_time: a record may have its own origin where that is said") {
  CHECK(uniform_time(table_of("time_s\n-1\n-0.5\n0\n0.5\n"), TimeOrigin::any) == UniformGrid{0.5, 4});
}
