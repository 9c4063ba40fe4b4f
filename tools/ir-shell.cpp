#include "impulse/response/modal_response.hpp"
#include "impulse/response/response_csv.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/model/modal_model.hpp"
#include "tools/support/shell_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

namespace {

using namespace impulse;

enum class Output { response, modes };

struct Request {
  ShellOptions body;
  Output as = Output::response;
  std::optional<double> step_s;
  std::optional<double> duration_s;
  std::optional<std::size_t> modes;
  std::string output;

  void declare(Command& command) {
    body.declare(command, ShellOptions::Use::impact);
    command.quantity("--step", step_s, "s", Sign::positive, "time step of the response");
    command.quantity("--duration", duration_s, "s", Sign::positive, "duration; round(duration/step) + 1 samples");
    command.choice<Output>("--as", as, {{"response", Output::response}, {"modes", Output::modes}}, "what to write");
    command.count("--modes", modes, 1,
                  "number of modes; those left out answer statically (default: a quarter of the mesh's degrees of "
                  "freedom, at most 200)");
    command.output(output);
  }

  void require_consistent() const {
    if (as == Output::modes && step_s) throw UsageError("--step", "modes have no step; leave it out with --as modes");
    if (as == Output::modes && duration_s)
      throw UsageError("--duration", "modes have no duration; leave it out with --as modes");
    if (as == Output::response && !step_s) throw UsageError("--step", "is required for a response");
    if (as == Output::response && !duration_s) throw UsageError("--duration", "is required for a response");
  }

  [[nodiscard]] ModalModel modal_body() const {
    const Shell shell(body.panel());
    const auto unknowns = static_cast<std::size_t>(shell.size());
    if (modes && *modes > unknowns)
      throw UsageError("--modes", fmt::format("{} modes are asked for, but the mesh has only {} degrees of freedom; "
                                              "use more --elements",
                                              *modes, unknowns));
    const std::size_t standard = std::clamp<std::size_t>(unknowns / 4, 1, 200);
    return modal_model(shell_structure(shell, body.points()),
                       {.mode_count = modes.value_or(standard), .residual = ModalOptions::Residual::attached});
  }

  int run() const {
    require_consistent();
    if (as == Output::modes) {
      write_modes(output, modal_body());
      return 0;
    }
    const UniformGrid grid = grid_over(*duration_s, *step_s);
    write_response(output, modal_response(modal_body(), grid));
    return 0;
  }
};

}  // namespace

int main(int argc, char** argv) {
  Command command(
      {"ir-shell", "impulse response of a thin laminated panel, flat, cylindrical or spherical, by shell elements",
       "Linear Kirchhoff-Love theory: no transverse shear, so that the answer under a point force has a limit. "
       "Displacements and forces count into the panel, along its normal at the point.",
       "ir-shell --size 152.4mm,101.6mm --layup '[0/45/0/-45/0]2s' --ply graphite-epoxy --thickness 2.69mm \\\n"
       "  --curvature-radius 10.76m --edges IIII --step 1us --duration 400us"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] { return request.run(); });
}
