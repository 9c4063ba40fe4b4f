#include "lib/records/record_unit.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

using namespace impulse;

TEST_CASE("record_unit reads what laboratories write") {
  struct Row {
    const char *text, *si;
    double factor;
  };
  for (const Row& row : {Row{"N", "N", 1},
                         Row{"kN", "N", 1e3},
                         Row{"mm/s", "m/s", 1e-3},
                         Row{"m/s²", "m/s2", 1},
                         Row{"m/s^2", "m/s2", 1},
                         Row{"m/s**2", "m/s2", 1},
                         Row{"g", "m/s2", 9.80665},
                         Row{"g²/Hz", "m2/s4/Hz", 9.80665 * 9.80665},
                         Row{"µε", "1", 1e-6},
                         Row{"ε", "1", 1},
                         Row{"µm/m", "1", 1e-6},
                         Row{"%", "1", 0.01},
                         Row{"Volts", "V", 1},
                         Row{"mV", "V", 1e-3},
                         Row{"ms", "s", 1e-3},
                         Row{"Nm", "N m", 1},
                         Row{"N s", "N s", 1},
                         Row{"Ns", "N s", 1},
                         Row{"(1/N)*(m/s²)", "1/kg", 1},
                         Row{"(m/s^2)/N", "1/kg", 1},
                         Row{"kg", "kg", 1},
                         Row{"psi", "Pa", 6894.757293168361},
                         Row{"m/(N s)", "m/(N s)", 1},
                         Row{"W/m2", "kg.s-3", 1},
                         Row{"Pa", "Pa", 1},
                         Row{"rad/s", "rad/s", 1}}) {
    CAPTURE(std::string(row.text));
    const std::optional<RecordUnit> unit = record_unit(row.text);
    REQUIRE(unit);
    CHECK(unit->si == row.si);
    CHECK(unit->factor == doctest::Approx(row.factor).epsilon(1e-13).scale(0));
    CHECK(unit->offset == 0);
  }
  const std::optional<RecordUnit> celsius = record_unit("°C");
  REQUIRE(celsius);
  CHECK(celsius->si == "K");
  CHECK(celsius->offset == about(273.15));
  CHECK(celsius->factor == about(1));
}

TEST_CASE("record_unit does not guess") {
  for (const char* text : {"", "NONE", "-", "EU", "voltage", "m 3", "m*3", "5 N", "3", "N/m^1.5"}) {
    CAPTURE(std::string(text));
    CHECK_FALSE(record_unit(text));
  }
}

TEST_CASE("units of products are those of SI") {
  CHECK(unit_product("V", "N/V") == "N");
  CHECK(unit_quotient("V", "V/N") == "N");
  CHECK(unit_product("1", "N") == "N");
  CHECK(unit_quotient("m/s2", "N") == "1/kg");
}

TEST_CASE("columns are named after channel and unit, once") {
  CHECK(column_name("Mic 01", "Pa") == "Mic 01_Pa");
  CHECK(column_name("force_N", "N") == "force_N");
  CHECK(column_name("strain", "1") == "strain");
  CHECK(unit_suffix("m/(N s)") == "_m_per_Ns");
  CHECK(unit_suffix("1/kg") == "_per_kg");
  CHECK(unit_suffix("kg.m2.s-3") == "_kgm2_per_s3");
  CHECK(unit_suffix("m/s2") == "_m_per_s2");
  CHECK(unit_suffix("kg.s-1") == "_kg_per_s");
}

TEST_CASE("headings are taken apart") {
  struct Row {
    const char *text, *name, *unit;
  };
  for (const Row& row :
       {Row{"Force [kN]", "Force", "kN"}, Row{"Time (s)", "Time", "s"}, Row{"Zeit/ms", "Zeit", "ms"},
        Row{"gauge (left)", "gauge (left)", ""}, Row{"H1 (m/(N s))", "H1", "m/(N s)"},
        Row{"incident_bar_signal/ε", "incident_bar_signal", "ε"}, Row{"signal/voltage", "signal/voltage", ""},
        Row{"velocity_1_m_per_s", "velocity_1", "m/s"}, Row{"impulse_response_per_kg", "impulse_response", "1/kg"},
        Row{"step_displacement_m_per_N", "step_displacement", "m/N"}, Row{"time_s", "time", "s"}, Row{"CH1", "CH1", ""},
        Row{"drift [EU]", "drift", "EU"}, Row{" a b ", "a b", ""}}) {
    CAPTURE(std::string(row.text));
    const Heading heading = parse_heading(row.text);
    CHECK(heading.name == row.name);
    CHECK(heading.unit == row.unit);
  }
}
