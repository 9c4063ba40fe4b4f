#include "lib/records/text_record.hpp"

#include "lib/contract/errors.hpp"
#include "tests/support/about.hpp"
#include "tests/support/temporary_directory.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

using namespace impulse;

namespace {

Record read(const std::string& text, const TextOptions& options = {}, const Sampling& sampling = {}) {
  const test::TemporaryDirectory folder;
  const RecordFile file(folder.write("record", text));
  return collect_record(*read_text_records(file, TextDialect::any, options, sampling).front());
}

std::string refusal(const std::string& text, const TextOptions& options = {}) {
  try {
    (void)read(text, options);
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.rfind("/record") + 8);
  }
  return "none";
}

/// The same 30 rows in another spelling.
std::string spelled(const std::string& delimiter, char sign, const std::string& end) {
  std::string text = "time_s" + delimiter + "force_N" + end;
  for (int k = 0; k < 30; ++k) {
    std::string row = fmt::format("{:.3f}{}{:.2e}", 0.001 * k, delimiter, std::sin(k));
    for (char& c : row)
      if (c == '.') c = sign;
    text += row + end;
  }
  return text;
}

}  // namespace

TEST_CASE("a text is read alike, whatever its delimiter, decimal sign and line ends") {
  const Record reference = read(spelled(",", '.', "\n"));
  REQUIRE(reference.abscissa.size == 30);
  CHECK(reference.abscissa.step == 0.001);
  CHECK(reference.channels.at(0).info.name == "force");
  CHECK(reference.channels.at(0).info.unit == "N");
  for (const char* delimiter : {",", ";", "\t", "|", "   ", " , "})
    for (const char sign : {'.', ','})
      for (const char* end : {"\n", "\r\n", "\r", "\r\r\n", "\n\n"}) {
        if (sign == ',' && std::string(delimiter).find(',') != std::string::npos) continue;
        CAPTURE(fmt::format("delimiter '{}' sign '{}'", delimiter, sign));
        const Record record = read(spelled(delimiter, sign, end));
        CHECK(record.abscissa.step == reference.abscissa.step);
        CHECK(record.channels.at(0).values == reference.channels.at(0).values);
      }
}

TEST_CASE("a text of many blocks is read like its rows") {
  // Beyond the buffer of a MiB, so that rows straddle its end; the rows say where they are.
  std::string text = "time_s,a,b\n";
  for (int k = 0; k < 160000; ++k) text += fmt::format("{:.6f},{},{}\n", 1e-6 * k, k, -k);
  const Record record = read(text);
  REQUIRE(record.abscissa.size == 160000);
  for (int k = 0; k < 160000; ++k) {
    const auto i = static_cast<std::size_t>(k);
    REQUIRE(record.channels[0].values[i] == k);
    REQUIRE(record.channels[1].values[i] == -k);
    REQUIRE(record.abscissa.at(i) == about(1e-6 * k).epsilon(1e-14));
  }
}

TEST_CASE("a heading of 100 kB is read, one of 5 MB refused") {
  std::string rows;
  for (int k = 0; k < 200; ++k) rows += fmt::format("{},{}\n", k, k * k);
  const std::string line = "note: " + std::string(93, 'x') + "\n";
  std::string heading;
  for (int k = 0; k < 1000; ++k) heading += line;
  CHECK(read(heading + "time_s,a\n" + rows).abscissa.size == 200);
  std::string gigantic;
  for (int k = 0; k < 50; ++k) gigantic += heading;
  CHECK(refusal(gigantic + "time_s,a\n" + rows).find("no rows of numbers") != std::string::npos);
}

TEST_CASE("an error behind what is looked at first has its line and field") {
  std::string text = "time_s,a,b\n";
  for (int k = 0; k < 20000; ++k) text += fmt::format("{},1,2\n", k);
  CHECK(refusal(text + "20000,1,x\n20001,1,2\n") == "20002:3: 'x' is not a finite number");
  CHECK(refusal(text + "20000,1\n20001,1,2\n") == "20002:3: the row breaks off after 2 of 3 fields");
  CHECK(refusal(text + "20000,,2\n20001,1,2\n") == "20002:2: empty field");
  CHECK(refusal(text + "x,1,2\n20001,1,2\n") == "20002:1: 'x' is not a finite number");
  CHECK(refusal(text + "20000,1e999,2\n20001,1,2\n") == "20002:2: '1e999' is not a finite number");
  CHECK(refusal(text + "20000,1 1,2\n20001,1,2\n") == "20002:2: '1 1' is not a finite number");
  CHECK(refusal(text + "2000000,1,2\n20001,1,2\n").starts_with("20003: time 20001 follows 2000000"));
}

TEST_CASE("a last row that breaks off is left out, and said so") {
  for (const char* end : {"3", "3,", "3,1", "3,1,", "3,1,\n", "3,1,\n\n# end\n"}) {
    CAPTURE(std::string(end));
    const Record record = read(std::string("time_s,a,b\n0,1,2\n1,1,2\n2,1,2\n") + end);
    CHECK(record.abscissa.size == 3);
    REQUIRE(record.notes.size() == 1);
    CHECK(record.notes[0].starts_with("the last line (5) breaks off"));
  }
}

TEST_CASE("times in single precision are even") {
  std::string text = "time_s,a\n";
  for (int k = 0; k < 100000; ++k)
    text += fmt::format("{:.9g},1\n", static_cast<double>(static_cast<float>(1 + 1e-6 * k)));
  const Record record = read(text);
  CHECK(record.abscissa.step == 1e-6);
  CHECK(record.abscissa.start == 1);
  REQUIRE(record.notes.size() == 1);
  CHECK(record.notes[0].find("single precision") != std::string::npos);
}

TEST_CASE("letters of any code become UTF-8") {
  CHECK(read("time_s,\xC3\xA4 [\xC2\xB5m]\n0,1\n1,2\n").channels[0].info.name == "ä");
  CHECK(read("time_s,\xE4 [\xB5m]\n0,1\n1,2\n").channels[0].info.unit == "µm");
  CHECK(read("time_s,gauge/\xA6\xC5\n0,1\n1,2\n").channels[0].info.unit == "ε");
  TextOptions cyrillic;
  cyrillic.encoding = "KOI8-R";
  CHECK(read("time_s,\xF3\n0,1\n1,2\n", cyrillic).channels[0].info.name == "С");
  CHECK(read("\xEF\xBB\xBFtime_s,a\n0,1\n1,2\n").abscissa.size == 2);
}
