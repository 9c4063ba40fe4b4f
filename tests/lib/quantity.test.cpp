#include "lib/cli/quantity.hpp"

#include <doctest/doctest.h>

#include <clocale>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

using impulse::parse_quantity;

namespace {

// Conversion is one product with a factor that UDUNITS rounds once or twice.
doctest::Approx rounded(double value) { return doctest::Approx(value).epsilon(1e-14).scale(0); }

}  // namespace

TEST_CASE("parse_quantity reads bare numbers in the SI unit") {
  CHECK(parse_quantity("0.4", "m") == 0.4);
  CHECK(parse_quantity("-1.5e-3", "m") == -1.5e-3);
  CHECK(parse_quantity("+7", "kg") == 7);
  CHECK(parse_quantity(" .5 ", "1") == 0.5);
  CHECK(parse_quantity("1e-400", "m") == 0);
}

TEST_CASE("parse_quantity converts every unit of the documentation") {
  struct Row {
    const char *text, *unit;
    double value;
  };
  const double pound = 0.45359237, foot = 0.3048, inch = 0.0254, gravity = 9.80665;
  for (const Row& row : {Row{"400mm", "m", 0.4},
                         {"40cm", "m", 0.4},
                         {"400 mm", "m", 0.4},
                         {"3in", "m", 3 * inch},
                         {"2.8GPa", "Pa", 2.8e9},
                         {"10us", "s", 1e-5},
                         {"10µs", "s", 1e-5},
                         {"3ms", "s", 3e-3},
                         {"1150kg/m3", "kg/m3", 1150},
                         {"1.15g/cm3", "kg/m3", 1150},
                         {"0.5ft.lbf", "J", 0.5 * foot * pound * gravity},
                         {"2.5lb", "kg", 2.5 * pound},
                         {"3kg", "kg", 3},
                         {"20g", "kg", 0.02},
                         {"20Mpsi", "Pa", 20e6 * pound * gravity / (inch * inch)},
                         {"5m/s", "m/s", 5},
                         {"18km/h", "m/s", 5},
                         {"2kHz", "Hz", 2000},
                         {"7Hz", "Hz", 7},
                         {"5kN", "N", 5000},
                         {"2kN/mm", "N/m", 2e6},
                         {"300rad/s", "rad/s", 300}}) {
    CAPTURE(row.text);
    CHECK(parse_quantity(row.text, row.unit) == rounded(row.value));
  }
}

TEST_CASE("parse_quantity raises the length under a power 3/2") {
  CHECK(parse_quantity("1.413e6N/cm^1.5", "N/m^1.5") == rounded(1.413e9));
  CHECK(parse_quantity("1.413e9", "N/m^1.5") == 1.413e9);
  CHECK(parse_quantity("2N/m^1.5", "N/m^1.5") == rounded(2));
  CHECK(parse_quantity("1kN/mm^1.5", "N/m^1.5") == rounded(1e3 * std::pow(1e3, 1.5)));
  CHECK_THROWS_WITH((void)parse_quantity("5N/m", "N/m^1.5"),
                    "'5N/m': wrong dimension: expected a stiffness of a 3/2 law such as 1.4e6N/cm^1.5");
  CHECK_THROWS_WITH((void)parse_quantity("5kg/m^1.5", "N/m^1.5"),
                    "'5kg/m^1.5': wrong dimension: expected a stiffness of a 3/2 law such as 1.4e6N/cm^1.5");
  CHECK_THROWS_WITH((void)parse_quantity("5N/m^1.5", "N/m"),
                    "'5N/m^1.5': wrong dimension: expected a stiffness such as 2kN/mm");
}

TEST_CASE("parse_quantity refuses by saying the text, the expectation and an example") {
  CHECK_THROWS_WITH((void)parse_quantity("5kg", "m"), "'5kg': wrong dimension: expected a length such as 400mm");
  CHECK_THROWS_WITH((void)parse_quantity("5furlongz", "m"),
                    "'5furlongz': unknown unit 'furlongz': expected a length such as 400mm");
  CHECK_THROWS_WITH((void)parse_quantity("abc", "m"), "'abc': not a number: expected a length such as 400mm");
  CHECK_THROWS_WITH((void)parse_quantity("1,5mm", "m"), doctest::Contains("'1,5mm': the decimal sign is a point"));
  CHECK_THROWS_WITH((void)parse_quantity("", "m"), "'': empty: expected a length such as 400mm");
  CHECK_THROWS_WITH((void)parse_quantity("1e999", "m"),
                    "'1e999': too large for a number: expected a length such as 400mm");
  CHECK_THROWS_WITH((void)parse_quantity("3%", "1"), "'3%': unexpected '%' after the number: expected a plain number");
  for (const char* text :
       {"inf", "nan", "-inf", "+-1", "--1", "1,5", "5 m 3", "5m^1.5", "5/m", "5m@3", "5m*3", "0x10"}) {
    CAPTURE(text);
    CHECK_THROWS_AS((void)parse_quantity(text, "m"), std::invalid_argument);
  }
}

TEST_CASE("parse_quantity keeps cycles, radians and their reciprocals apart") {
  for (const char* text : {"100rad/s", "100rpm", "1ms"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH_AS((void)parse_quantity(text, "Hz"), doctest::Contains("wrong dimension"), std::invalid_argument);
  }
  CHECK_THROWS_AS((void)parse_quantity("1Hz", "rad/s"), std::invalid_argument);
  CHECK_THROWS_AS((void)parse_quantity("1Hz", "s"), std::invalid_argument);
}

TEST_CASE("parse_quantity does not depend on the locale") {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "sv_SE.UTF-8", "C.UTF-8"}) {
    if (!std::setlocale(LC_NUMERIC, locale)) continue;
    CHECK(parse_quantity("1.5mm", "m") == rounded(1.5e-3));
  }
  std::setlocale(LC_NUMERIC, before.c_str());
}
