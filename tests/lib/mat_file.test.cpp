#include "lib/records/mat_file.hpp"

#include "lib/contract/errors.hpp"
#include "lib/records/mat_arrays.hpp"
#include "tests/support/temporary_directory.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

using namespace impulse;

namespace {

Record sample(bool even) {
  Record record;
  record.abscissa = {"time", "s", -1.0 / 3, even ? 1.0 / 65536 : 0, 40};
  Channel real{{"Mic 01 (links) µ", "Pa", "pressure", false}, {}, {}}, complex{{"H1", "m/(N s)", "", true}, {}, {}};
  for (int k = 0; k < 40; ++k) {
    if (!even) record.abscissa_values.push_back(k * k / 7.0);
    real.values.push_back(std::sin(k) / 3);
    complex.values.push_back(std::exp(k));
    complex.imaginary.push_back(-1.0 / (k + 1));
  }
  Channel third = real;
  third.info.name.assign(1, '1');  // no identifier of MATLAB's
  record.channels = {real, complex, third};
  return record;
}

std::string refusal(const std::string& bytes) {
  const test::TemporaryDirectory folder;
  const RecordFile file(folder.write("record", bytes));
  try {
    (void)read_mat_file(file, {});
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.rfind("/record") + 7);
  }
  return "none";
}

}  // namespace

TEST_CASE("a MATLAB file that was written reads back the same") {
  for (const MatVersion version : {MatVersion::v5, MatVersion::v73})
    for (const bool even : {true, false}) {
      const test::TemporaryDirectory folder;
      const Record record = sample(even);
      write_mat_file(folder / "out.mat", record, version);
      CHECK(folder.file_count() == 1);
      const RecordFile file(folder / "out.mat");
      CHECK(is_mat_file(file.head(100)));
      const std::vector<Record> records = read_mat_file(file, {});
      REQUIRE(records.size() == 1);
      const Record& back = records.front();
      CHECK(back.abscissa.name == "time");
      CHECK(back.abscissa.unit == "s");
      CHECK(back.abscissa.start == record.abscissa.start);
      CHECK(back.abscissa.step == record.abscissa.step);
      CHECK(back.abscissa_values == record.abscissa_values);
      REQUIRE(back.channels.size() == 3);
      for (std::size_t c = 0; c < 3; ++c) {
        CHECK(back.channels[c].info.name == record.channels[c].info.name);
        CHECK(back.channels[c].info.unit == record.channels[c].info.unit);
        CHECK(back.channels[c].info.quantity == record.channels[c].info.quantity);
        CHECK(back.channels[c].values == record.channels[c].values);
        CHECK(back.channels[c].imaginary == record.channels[c].imaginary);
      }
    }
}

TEST_CASE("a damaged MATLAB file is refused, whatever it does to matio") {
  const test::TemporaryDirectory folder;
  for (const MatVersion version : {MatVersion::v5, MatVersion::v73}) {
    write_mat_file(folder / "out.mat", sample(true), version);
    const std::string whole = folder.read("out.mat");
    CHECK(refusal(whole.substr(0, 60)) == ": no MATLAB file that matio can open");
    // Cut off, it may hold whole vectors; what must not happen is a crash.
    for (std::size_t part = 1; part < 8; ++part) (void)refusal(whole.substr(0, part * whole.size() / 8));
    for (std::size_t at = 128; at < whole.size(); at += whole.size() / 8) {
      std::string changed = whole;
      changed[at] = static_cast<char>(~changed[at]);
      (void)refusal(changed);
    }
  }
  write_mat_file(folder / "out.mat", sample(true), MatVersion::v5);
  const std::string whole = folder.read("out.mat");
  CHECK(refusal(whole.substr(0, 200)) ==
        ": byte 129: the variable that begins here breaks off (the file has 200 bytes)");
  for (std::size_t length = 129; length < whole.size(); length += 97) CHECK(refusal(whole.substr(0, length)) != "none");
  CHECK(refusal("") != "none");
}
