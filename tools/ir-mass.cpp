#include "impulse/response/mass_response.hpp"
#include "impulse/response/response_csv.hpp"
#include "lib/cli/mass_options.hpp"
#include "lib/cli/run_tool.hpp"

int main(int argc, char** argv) {
  using namespace impulse;
  Command command(
      {"ir-mass", "impulse response of a rigid mass",
       "G = 1/m, H = t/m, U = t²/(2m). Displacements and forces count into the body, so that between its two "
       "sides the sign turns.",
       "ir-mass --mass 2.5lb --step 1us --duration 1ms"});
  MassOptions body;
  double step_s = 0;
  double duration_s = 0;
  std::string output;
  body.declare(command);
  command.quantity("--step", step_s, "s", Sign::positive, "time step of the response").required();
  command.quantity("--duration", duration_s, "s", Sign::positive, "duration; round(duration/step) + 1 samples")
      .required();
  command.output(output);
  return run_tool(argc, argv, command, [&] {
    body.require_valid();
    write_response(output, mass_response(body.mass_kg, body.faces, grid_over(duration_s, step_s)));
    return 0;
  });
}
