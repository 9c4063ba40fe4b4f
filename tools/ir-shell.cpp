#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "lib/model/modal_model.hpp"
#include "tools/support/modal_request.hpp"
#include "tools/support/shell_body.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace {

using namespace impulse;

struct Request {
  ShellOptions body;
  ModalRequest modal;

  void declare(Command& command) {
    body.declare(command, ShellOptions::Use::impact);
    modal.declare(command,
                  "up to the step's Nyquist frequency, at most 200 and a quarter of the mesh's degrees of freedom; the "
                  "others answer statically");
  }

  [[nodiscard]] ModalModel modal_body() const {
    const Shell shell(body.panel());
    const auto unknowns = static_cast<std::size_t>(shell.size());
    const std::size_t count = modal.mode_count().value_or(std::clamp<std::size_t>(unknowns / 4, 1, 200));
    if (count > unknowns)
      throw UsageError("--modes", fmt::format("{} modes are asked for, but the mesh has only {} degrees of freedom; "
                                              "use more --elements",
                                              count, unknowns));
    return modal_model(shell_structure(shell, body.points()), {.mode_count = count,
                                                               .highest_frequency_Hz = modal.highest_frequency_Hz(),
                                                               .residual = ModalOptions::Residual::attached});
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
  return run_tool(argc, argv, command, [&] {
    request.modal.require_consistent(command);
    request.modal.write(request.modal_body());
    return 0;
  });
}
