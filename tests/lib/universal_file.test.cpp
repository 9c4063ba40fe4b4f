#include "lib/records/universal_file.hpp"

#include "lib/contract/errors.hpp"
#include "tests/support/about.hpp"
#include "tests/support/temporary_directory.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

using namespace impulse;

namespace {

std::vector<Record> read(const std::string& bytes, const BinaryOptions& options = {}) {
  const test::TemporaryDirectory folder;
  const RecordFile file(folder.write("record", bytes));
  return read_universal_file(file, options);
}

std::string refusal(const std::string& bytes, const BinaryOptions& options = {}) {
  try {
    (void)read(bytes, options);
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.rfind("/record") + 7);
  }
  return "none";
}

struct Form {
  int type = 4, even = 1;
  std::size_t count = 3;
  std::string number = "58", axis = "        13    0    0    0 force                N",
              below = "         0    0    0    0 NONE                 NONE", end = "\n";
  std::string name = "hammer";
};

std::string heading(const Form& form) {
  std::string text;
  for (const std::string& line :
       {std::string("    -1"), "    " + form.number, std::string("first"), std::string("NONE"), std::string("NONE"),
        std::string("NONE"), std::string("NONE"),
        fmt::format("    1         0    0         0 {:<10}         0   0 NONE               0   0", form.name),
        fmt::format("{:10}{:10}{:10}  1.00000E+00  5.00000E-01  0.00000E+00", form.type, form.count, form.even),
        std::string("        17    0    0    0 time                 s"), form.axis, form.below,
        std::string("         0    0    0    0 NONE                 NONE")})
    text += line + form.end;
  return text;
}

std::string with_values(const Form& form, const std::string& values) {
  return heading(form) + values + form.end + "    -1" + form.end;
}

/// Values as bytes, in either order and precision.
std::string bytes_of(const std::vector<double>& values, bool is_double, ByteOrder order) {
  std::string bytes;
  for (const double value : values) {
    std::array<char, 8> raw{};
    const std::size_t size = is_double ? 8 : 4;
    const std::uint64_t bits =
        is_double ? std::bit_cast<std::uint64_t>(value) : std::bit_cast<std::uint32_t>(static_cast<float>(value));
    for (std::size_t i = 0; i < size; ++i) raw[i] = static_cast<char>(bits >> 8 * i & 0xFF);
    if (order == ByteOrder::big) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
    bytes.append(raw.data(), size);
  }
  return bytes;
}

std::string binary_number(ByteOrder order, std::size_t bytes) {
  return fmt::format("58b{:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}", order == ByteOrder::little ? 1 : 2, 2, 11, bytes, 0, 0,
                     0, 0);
}

Record sample(std::size_t size, bool even, bool is_complex) {
  Record record;
  record.abscissa = {"time", "s", -1.0 / 3, even ? 1.0 / 65536 : 0, size};
  Channel channel{{"a rather long name of a channel, with a comma", "m/s2", "", is_complex}, {}, {}};
  for (std::size_t k = 0; k < size; ++k) {
    const double x = static_cast<double>(k);
    if (!even) record.abscissa_values.push_back(x * x / 7);
    channel.values.push_back(std::sin(x) * std::pow(10, static_cast<double>(k % 7) - 3));
    if (is_complex) channel.imaginary.push_back(-std::cos(x) / 3);
  }
  record.channels = {channel, channel};
  record.channels[1].info.name = "second";
  return record;
}

Record rewritten(const Record& record, UniversalForm form) {
  const test::TemporaryDirectory folder;
  write_universal_file(folder / "out.uff", record, form);
  const std::vector<Record> records = read(folder.read("out.uff"));
  REQUIRE(records.size() == 1);
  return records.front();
}

}  // namespace

TEST_CASE("a universal file that was written reads back the same") {
  for (const std::size_t size : {1U, 2U, 3U, 4U, 7U, 1000U})
    for (const bool even : {true, false})
      for (const bool is_complex : {true, false}) {
        CAPTURE(fmt::format("{} samples, even {}, complex {}", size, even, is_complex));
        const Record record = sample(size, even, is_complex);
        const Record binary = rewritten(record, UniversalForm::binary);
        REQUIRE(binary.channels.size() == 2);
        CHECK(binary.abscissa.start == (even ? record.abscissa.start : 0));
        CHECK(binary.abscissa.step == record.abscissa.step);
        CHECK(binary.abscissa_values == record.abscissa_values);
        for (std::size_t c = 0; c < 2; ++c) {
          CHECK(binary.channels[c].info.name == record.channels[c].info.name);
          CHECK(binary.channels[c].info.unit == "m/s2");
          CHECK(binary.channels[c].info.quantity == "acceleration");
          CHECK(binary.channels[c].values == record.channels[c].values);
          CHECK(binary.channels[c].imaginary == record.channels[c].imaginary);
        }
        const Record text = rewritten(record, UniversalForm::text);
        REQUIRE(text.channels.size() == 2);
        CHECK(text.abscissa.step == record.abscissa.step);
        // Thirteen digits, as the format has them; half a unit of the last is 5e-13 at the most.
        for (std::size_t k = 0; k < size; ++k)
          CHECK(std::abs(text.channels[0].values[k] - record.channels[0].values[k]) <=
                5e-13 * std::abs(record.channels[0].values[k]));
        // What has been through the format once doesn't change any more.
        CHECK(rewritten(text, UniversalForm::text).channels[1].values == text.channels[1].values);
      }
}

TEST_CASE("numbers of a universal text need no blanks, letters or full lines") {
  for (const char* values :
       {" 1.00000E+00-2.00000E+00 2.50000E-01", "1 -2 .25", " 1.00000D+00-2.00000D+00 2.5D-1",
        " 1.0E+000-2.0E+000 2.5E-001\r", " 1.0\n-2.0\n2.5e-1", " 1.00000+000-2.00000+000 2.50000-001",
        " 1.0E+00 -2.0E+00 2.5E-01                                           "}) {
    CAPTURE(std::string(values));
    for (const char* end : {"\n", "\r\n"}) {
      Form form;
      form.type = 2;
      form.end = end;
      const std::vector<Record> records = read(with_values(form, values));
      REQUIRE(records.size() == 1);
      CHECK(records[0].channels[0].values == std::vector<double>{1, -2, 0.25});
      CHECK(records[0].channels[0].info.name == "hammer");
      CHECK(records[0].channels[0].info.unit == "N");
      CHECK(records[0].abscissa.at(2) == 2);
    }
  }
}

TEST_CASE("even, uneven, real and complex texts have their columns") {
  Form form;
  form.type = 5;
  form.even = 0;
  form.count = 2;
  const Record record = read(with_values(form, "0 1 2 5 3 4")).front();
  CHECK(record.abscissa_values == std::vector<double>{0, 5});
  CHECK(record.channels[0].values == std::vector<double>{1, 3});
  CHECK(record.channels[0].imaginary == std::vector<double>{2, 4});
  CHECK(record.channels[0].info.is_complex);
}

TEST_CASE("binary datasets of every order and precision are read, with stray line ends") {
  const std::vector<double> values{1.5, -2, 0.25};
  for (const bool is_double : {false, true})
    for (const ByteOrder order : {ByteOrder::little, ByteOrder::big})
      for (const char* before : {"", "\n", "\r\n"})
        for (const char* behind : {"", "\n", "\r\n"}) {
          Form form;
          form.type = is_double ? 4 : 2;
          const std::string data = bytes_of(values, is_double, order);
          // The count of bytes in the heading is wrong in many files; that of samples isn't.
          form.number = binary_number(order, 12345);
          const Record record = read(heading(form) + before + data + behind + "    -1\n").front();
          CHECK(record.channels[0].values == values);
          CHECK((record.notes.empty() == std::string(before).empty()));
        }
}

TEST_CASE("dataset 164 makes values without a unit SI") {
  Form form;
  form.axis = "        11    1    0    0 velocity             NONE";
  // Feet: SI is the value over 3.28.
  const std::string units =
      "    -1\n   164\n         2British              2\n 3.28083989501312334D+00 2.24808943099710480D-01 1.8D+00\n "
      "4.5967D+02\n    -1\n";
  const Record record = read(units + with_values(form, "1 2 3")).front();
  CHECK(record.channels[0].info.unit == "m/s");
  CHECK(record.channels[0].values[1] == about(2 * 0.3048).epsilon(1e-12));
  form.axis = "        12    0    0    0 acc                  NONE";
  form.below = "        13    0    0    0 force                NONE";
  const Record inertance = read(units + with_values(form, "1 2 3")).front();
  CHECK(inertance.channels[0].info.unit == "(m/s2)/(N)");
  CHECK(inertance.channels[0].values[0] == about(0.3048 / (0.45359237 * 9.80665)).epsilon(1e-12));
}

TEST_CASE("other datasets are passed over, different times make records of their own") {
  Form other;
  other.count = 2;
  other.name = "plate";
  const std::string text = "\n    -1\n   151\nmodel\n    -1\n" + with_values({}, "1 2 3") + with_values({}, "4 5 6") +
                           with_values(other, "7 8");
  const std::vector<Record> records = read(text);
  REQUIRE(records.size() == 2);
  CHECK(records[0].channels.size() == 2);
  CHECK(records[1].channels[0].values == std::vector<double>{7, 8});
}

TEST_CASE("a heading in any code is read") {
  Form form;
  form.axis = "         1    0    0    0 Schwingung           m/s\xB2";
  CHECK(read(with_values(form, "1 2 3")).front().channels[0].info.unit == "m/s²");
  form.axis = "         1    0    0    0 L\xC3\xA4nge                µm";
  CHECK(read(with_values(form, "1 2 3")).front().channels[0].info.unit == "µm");
}

TEST_CASE("damaged universal files are refused where they are damaged") {
  const std::string whole = with_values({}, "1 2 3");
  CHECK(refusal("    -1\n") == ":1: no dataset 58 in it");
  CHECK(refusal(heading({}) + "1 2\n    -1\n") ==
        ":15: the dataset breaks off after 2 of 3 values (from line 14 on; --incomplete takes them)");
  CHECK(refusal(with_values({}, "1 x 3")) == ":14: 'x 3' is no number");
  CHECK(refusal(with_values({}, "1 ****** 3")) == ":14: '****** 3' is no number");
  CHECK(refusal(with_values({}, "1 1e999 3")) == ":14: a number is too large");
  CHECK(refusal(with_values({}, "1 2 3 4 5 6 7 8 9 10")) == ":14: more than the 3 values that the heading says");
  CHECK(refusal("    -1\n    58\nfirst\n") == ":4: the heading of dataset 58 breaks off");
  CHECK(refusal(whole + "rubbish\n") == ":16: expected the -1 that begins a dataset, found 'rubbish'");
  Form gigantic;
  gigantic.count = 999999999;
  CHECK(refusal(with_values(gigantic, "1 2 3")).find("breaks off after 3 of 999999999 values") != std::string::npos);
  Form type;
  type.type = 3;
  CHECK(refusal(with_values(type, "1 2 3")) == ":9: data type 3 of dataset 58 (2, 4, 5 and 6 are known)");
  // Every piece of a whole file is refused, or holds all its values.
  for (std::size_t length = 0; length + 8 < whole.size(); length += 3) {
    CAPTURE(length);
    CHECK(refusal(whole.substr(0, length)) != "none");
  }
}

TEST_CASE("damaged binary datasets are refused at their byte") {
  std::vector<double> values;
  for (int k = 0; k < 100; ++k) values.push_back(std::sin(k));
  Form form;
  form.count = values.size();
  form.number = binary_number(ByteOrder::little, 800);
  const std::string head = heading(form), whole = head + bytes_of(values, true, ByteOrder::little) + "    -1\n";
  CHECK(read(whole).front().channels[0].values == values);
  CHECK(
      refusal(whole.substr(0, head.size() + 80)) ==
      fmt::format(": byte {}: the file ends after 10 of 100 samples (values begin at byte {}; --incomplete takes them)",
                  head.size() + 81, head.size() + 1));
  BinaryOptions incomplete;
  incomplete.incomplete = Incomplete::take;
  CHECK(read(whole.substr(0, head.size() + 83), incomplete).front().abscissa.size == 10);
  const std::string swapped = head + bytes_of(values, true, ByteOrder::big) + "    -1\n";
  CHECK(refusal(swapped) == fmt::format(": byte {}: the values make sense only in the other byte order than the "
                                        "heading says (--byte-order big takes them so)",
                                        head.size() + 1));
  BinaryOptions big;
  big.byte_order = ByteOrder::big;
  CHECK(read(swapped, big).front().channels[0].values == values);
  CHECK(refusal(head + bytes_of(values, true, ByteOrder::little) + "garbage\n").find("no -1 behind the 800 bytes") !=
        std::string::npos);
  values[50] = NAN;
  CHECK(refusal(head + bytes_of(values, true, ByteOrder::little) + "    -1\n") ==
        fmt::format(": byte {}: a value is not finite", head.size() + 401));
  form.number = "58b     1     3          11         800     0     0           0           0";
  CHECK(refusal(heading(form) + bytes_of(values, true, ByteOrder::little)).find("floating-point format 3") !=
        std::string::npos);
}

TEST_CASE("a written heading has its fields in the columns of the format") {
  const test::TemporaryDirectory folder;
  Record record = sample(3, true, false);
  record.channels.resize(1);
  record.channels[0].info.name = "acc";
  write_universal_file(folder / "out.uff", record, UniversalForm::binary);
  const std::string text = folder.read("out.uff");
  const std::string expected =
      "    -1\n"
      "    58b     1     2          11          24     0     0           0           0\n"
      "acc\nNONE\nNONE\nir-convert: start -0.3333333333333333 step 1.52587890625e-05\nNONE\n"
      "    1         0    0         0 NONE               0   0 NONE               0   0\n"
      "         4         3         1 -3.33333e-01  1.52588e-05  0.00000e+00\n"
      "        17    0    0    0 time                 s                   \n"
      "        12    0    0    0 acc                  m/s2                \n"
      "         0    0    0    0 NONE                 NONE                \n"
      "         0    0    0    0 NONE                 NONE                \n";
  CHECK(text.substr(0, expected.size()) == expected);
  CHECK(text.size() == expected.size() + 24 + 7);
}

TEST_CASE("a step that a unit makes nothing of is refused") {
  Form form;
  std::string text = with_values(form, "1 2 3");
  text.replace(text.find("5.00000E-01"), 11, "5.0000E-320");
  text.replace(text.find(" s\n"), 3, " ns\n");
  CHECK(refusal(text).find("the step of the even abscissa is 0 s") != std::string::npos);
}
