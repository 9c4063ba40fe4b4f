#include "lib/records/record.hpp"

#include "lib/contract/errors.hpp"
#include "lib/records/record_conversion.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace impulse;
using Calibration = RecordConversion::Calibration;

namespace {

Record sample() {
  Record record;
  record.abscissa = {"time", "s", -2e-6, 1e-6, 4};
  record.channels.push_back({{"hammer", "mV", "", false}, {1, 2, 3, 4}, {}});
  record.channels.push_back({{"H", "", "", true}, {5, 6, 7, 8}, {-5, -6, -7, -8}});
  return record;
}

Record convert(const RecordConversion& conversion) {
  return collect_record(*converted_record(record_rows(sample()), conversion));
}

std::string refusal(const RecordConversion& conversion) {
  try {
    (void)convert(conversion);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("an abscissa has the decimals of its start and step") {
  const Abscissa micro{"time", "s", -5e-5, 1e-7, 5000};
  CHECK(micro.at(1) == -4.99e-5);
  CHECK(micro.at(500) == 0);
  CHECK(micro.at(503) == 3e-7);
  const Abscissa off{"time", "s", 2.5e-7, 1e-6, 10};
  CHECK(off.at(3) == 3.25e-6);
  const Abscissa odd{"time", "s", 0.1, 0.3, 10};
  CHECK(odd.at(2) == 0.1 + 0.3 * 2);
}

TEST_CASE("a record survives its rows") {
  const Record record = collect_record(*record_rows(sample()));
  REQUIRE(record.channels.size() == 2);
  CHECK(record.abscissa.size == 4);
  CHECK(record.channels[0].values == sample().channels[0].values);
  CHECK(record.channels[1].imaginary == sample().channels[1].imaginary);
}

TEST_CASE("channels are made SI, chosen, named, scaled and cut") {
  CHECK(convert({}).channels[0].values == std::vector{0.001, 0.002, 0.003, 0.004});
  RecordConversion conversion;
  conversion.channels = {"2", "hammer"};
  conversion.names = {{"1", "force"}};
  conversion.calibrations = {parse_calibration("hammer=2mV/N", Calibration::Use::divide),
                             parse_calibration("H=-2kN", Calibration::Use::multiply)};
  conversion.from = -1e-6;
  conversion.to = 0;
  conversion.origin = RecordConversion::Origin::first_sample;
  const Record record = convert(conversion);
  REQUIRE(record.channels.size() == 2);
  CHECK(record.channels[0].info.name == "H");
  CHECK(record.channels[0].info.unit == "N");
  CHECK(record.channels[0].values == std::vector<double>{-12000, -14000});
  CHECK(record.channels[0].imaginary == std::vector<double>{12000, 14000});
  CHECK(record.channels[1].info.name == "force");
  CHECK(record.channels[1].info.unit == "N");
  CHECK(record.channels[1].values == std::vector<double>{1, 1.5});
  CHECK(record.abscissa.start == 0);
}

TEST_CASE("conversions that make no sense are refused") {
  RecordConversion conversion;
  conversion.from = 1;
  CHECK(refusal(conversion) == "no sample lies between --from and --to (the record runs from -2e-06 to 1e-06 s)");
  conversion = {};
  conversion.channels = {"3"};
  CHECK(refusal(conversion) == "--channel: no channel '3' (there are: hammer, H)");
  conversion = {};
  conversion.units = {{"H", "blorp"}};
  CHECK(refusal(conversion) == "--unit: unknown unit 'blorp'");
  for (const char* text : {"a", "=1", "a=", "a=0", "a=inf", "a=1blorp", "a=1degC"}) {
    CAPTURE(std::string(text));
    CHECK_THROWS_AS((void)parse_calibration(text, Calibration::Use::multiply), std::invalid_argument);
  }
}
