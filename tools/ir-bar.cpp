#include "tools/support/bar_tool.hpp"

int main(int argc, char** argv) {
  return impulse::run_bar_tool(argc, argv,
                               {"ir-bar", "impulse response of a bar: a chain of cylindrical and conical segments",
                                "One-dimensional theory: plane sections, longitudinal waves at sqrt(E/rho). Columns: "
                                "time_s; impulse_response_per_kg (velocity after a "
                                "unit impulse, Dirac pulses left out); step_velocity_m_per_Ns and "
                                "step_displacement_m_per_N (under a unit step force). Displacements "
                                "and forces count into the body.",
                                "ir-bar --segment 6150mm,10mm,steel --face A --step 1us --duration 1ms"},
                               impulse::BarOptions::Kind::chain);
}
