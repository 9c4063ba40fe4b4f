#include "impulse/response/mass_response.hpp"
#include "impulse/response/response_csv.hpp"
#include "lib/cli/run_tool.hpp"

int main(int argc, char** argv) {
  using namespace impulse;
  Command command({"ir-mass", "impulse response of a rigid mass", "G = 1/m, H = t/m, U = t²/(2m).",
                   "ir-mass --mass 2.5lb --step 1us --duration 1ms"});
  double mass_kg = 0;
  double step_s = 0;
  double duration_s = 0;
  std::string output;
  command.body("mass");
  command.quantity("--mass", mass_kg, "kg", Sign::positive, "mass").required();
  command.quantity("--step", step_s, "s", Sign::positive, "time step of the response").required();
  command.quantity("--duration", duration_s, "s", Sign::positive, "duration; round(duration/step) + 1 samples")
      .required();
  command.output(output);
  return run_tool(argc, argv, command, [&] {
    write_response(output, mass_response(mass_kg, grid_over(duration_s, step_s)));
    return 0;
  });
}
