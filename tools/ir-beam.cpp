#include "impulse/exact/beam_modes.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "tools/support/beam_options.hpp"
#include "tools/support/modal_request.hpp"

#include <fmt/format.h>

#include <limits>

namespace {

using namespace impulse;

enum class ModesFrom { exact, fe };

struct Request {
  BeamOptions body;
  ModalRequest modal;
  std::optional<ModesFrom> modes_from;
  std::optional<std::size_t> elements;
  MassMatrix mass_matrix = MassMatrix::consistent;

  void declare(Command& command) {
    body.declare(command);
    command.choice<ModesFrom>("--modes-from", modes_from, {{"exact", ModesFrom::exact}, {"fe", ModesFrom::fe}},
                              "modes of the continuous beam (Euler-Bernoulli), or of its finite elements (default: fe "
                              "if --element is given, else exact)");
    command.count("--elements", elements, 2, "finite elements along the beam");
    command.choice<MassMatrix>("--mass-matrix", mass_matrix,
                               {{"lumped", MassMatrix::lumped}, {"consistent", MassMatrix::consistent}},
                               "of the finite elements; lumped is what fe-impact uses");
    modal.declare(command);
  }

  [[nodiscard]] bool exact() const {
    return modes_from.value_or(body.names_element() ? ModesFrom::fe : ModesFrom::exact) == ModesFrom::exact;
  }

  void require_consistent(const Command& command) const {
    modal.require_consistent(command);
    if (exact() && body.names_element())
      throw UsageError("--modes-from", "an --element has no exact modes; leave one of them out");
    for (const char* flag : {"--elements", "--mass-matrix"})
      if (exact() && command.given(flag)) throw UsageError(flag, "belongs to finite elements; add --element hermite");
    if (!exact() && !elements) throw UsageError("--elements", "is required for finite elements");
    (void)body.model();  // refuses what an element needs and lacks, or does not take
  }

  [[nodiscard]] ModalModel modal_body(const Beam& beam) const {
    const std::size_t count = modal.mode_count().value_or(std::numeric_limits<std::size_t>::max());
    if (exact()) return exact_beam_modes(beam, {modal.highest_frequency_Hz(), count});
    const BeamModel model = body.model();
    const Structure structure = beam_structure(beam, model, beam_mesh_by_count(beam, model, *elements, mass_matrix));
    const auto dof_count = static_cast<std::size_t>(structure.mass.rows());
    if (modal.mode_count() && count > dof_count)
      throw UsageError("--modes",
                       fmt::format("{} modes are asked for, but {} elements have only {}; use more --elements", count,
                                   *elements, dof_count));
    return modal_model(structure, {.mode_count = count,
                                   .highest_frequency_Hz = modal.highest_frequency_Hz(),
                                   .residual = ModalOptions::Residual::attached});
  }
};

}  // namespace

int main(int argc, char** argv) {
  Command command(
      {"ir-beam", "impulse response of a uniform beam struck across its length",
       "Modal superposition with the residual flexibility of the modes left out. Exact modes are those of "
       "Euler-Bernoulli theory, without shear; plane-stress elements have it, and need a patch to press on. "
       "Columns: time_s; impulse_response_per_kg (velocity after a unit impulse); step_velocity_m_per_Ns "
       "and step_displacement_m_per_N (under a unit step force). Displacements and forces count into the "
       "body.",
       "ir-beam --length 15.35cm --width 1cm --height 1cm --material 215.75GPa:7960kg/m3:0.3 "
       "--supports simple --at 0.5 --step 0.1us --duration 400us"});
  Request request;
  request.declare(command);
  return run_tool(argc, argv, command, [&] {
    request.require_consistent(command);
    request.modal.write(request.modal_body(request.body.beam()));
    return 0;
  });
}
