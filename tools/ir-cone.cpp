#include "tools/support/bar_tool.hpp"

int main(int argc, char** argv) {
  return impulse::run_bar_tool(
      argc, argv,
      {"ir-cone", "impulse response of a conical bar",
       "One conical segment, otherwise as ir-bar. Columns: time_s; impulse_response_per_kg (velocity after a unit "
       "impulse, Dirac pulses left "
       "out); step_velocity_m_per_Ns and step_displacement_m_per_N (under a unit step force).",
       "ir-cone --length 400mm --diameters 30mm,75mm --material nylon-6 --face A --step 1us --duration 1ms"},
      impulse::BarOptions::Kind::cone);
}
