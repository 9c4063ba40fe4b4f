#include "lib/plot/axis_label.hpp"

#include <doctest/doctest.h>

using namespace impulse;

TEST_CASE("column_meaning splits a name into quantity and unit") {
  struct Row {
    const char *column, *label;
  };
  for (const Row& row : {Row{"force_N", "force (N)"},
                         {"time_s", "time (s)"},
                         {"velocity_1_m_per_s", "velocity 1 (m/s)"},
                         {"impulse_response_per_kg", "impulse response (1/kg)"},
                         {"step_velocity_m_per_Ns", "step velocity (m/(N s))"},
                         {"step_displacement_12_m_per_N", "step displacement 12 (m/N)"},
                         {"participation_per_sqrt_kg", "participation (1/√kg)"},
                         {"running_impulse_1_Ns", "running impulse 1 (N s)"},
                         {"frequency_Hz", "frequency (Hz)"},
                         {"damping_ratio", "damping ratio"},
                         {"in_contact_1", "in contact 1"},
                         {"x", "x"},
                         {"_s", " s"}}) {
    CAPTURE(row.column);
    CHECK(axis_label(column_meaning(row.column)) == row.label);
  }
}

TEST_CASE("readable_time_unit keeps the largest time between 1 and 1000") {
  CHECK(readable_time_unit(0).unit == "s");
  CHECK(readable_time_unit(1).unit == "s");
  CHECK(readable_time_unit(5e4).unit == "s");
  CHECK(readable_time_unit(0.5).unit == "ms");
  CHECK(readable_time_unit(1e-3).unit == "ms");
  CHECK(readable_time_unit(4e-4).unit == "µs");
  CHECK(readable_time_unit(4e-4).per_si == 1e6);
  CHECK(readable_time_unit(4e-8).unit == "ns");
}
