#include "tools/support/bar_tool.hpp"

#include "fem/bodies/bar_structure.hpp"
#include "fem/bodies/dispersion_correction.hpp"
#include "impulse/exact/bar_modes.hpp"
#include "impulse/response/wave_response.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"
#include "tools/support/modal_request.hpp"

#include <fmt/format.h>

#include <limits>
#include <numeric>

namespace impulse {
namespace {

enum class Method { wave, modal };
enum class ModesFrom { exact, fe };

struct Request {
  explicit Request(BarOptions::Kind kind) : body(kind) {}

  BarOptions body;
  ModalRequest modal;
  Method method = Method::wave;
  ModesFrom modes_from = ModesFrom::exact;
  std::optional<std::size_t> elements;
  MassMatrix mass_matrix = MassMatrix::lumped;
  FeFrequencies frequencies = FeFrequencies::plain;

  void declare(Command& command) {
    body.declare(command);
    command.choice<Method>("--method", method, {{"wave", Method::wave}, {"modal", Method::modal}},
                           "travelling waves (exact) or modal superposition");
    command.choice<ModesFrom>("--modes-from", modes_from, {{"exact", ModesFrom::exact}, {"fe", ModesFrom::fe}},
                              "modes of the continuous bar, or of its finite elements");
    command.count("--elements", elements, 1, "finite elements along the bar, shared out by travel time");
    command.choice<MassMatrix>("--mass-matrix", mass_matrix,
                               {{"lumped", MassMatrix::lumped}, {"consistent", MassMatrix::consistent}},
                               "of the finite elements");
    command.choice<FeFrequencies>("--fe-frequencies", frequencies,
                                  {{"plain", FeFrequencies::plain}, {"corrected", FeFrequencies::corrected}},
                                  "corrected: freed of the lumped mesh's dispersion");
    modal.declare(command);
  }

  void require_consistent(const Command& command) const {
    const bool by_modes = method == Method::modal || modal.wants_modes();
    if (modal.wants_modes() && command.given("--method") && method == Method::wave)
      throw UsageError("--method", "travelling waves have no modes; leave it out with --as modes");
    for (const char* flag : {"--modes", "--modes-from"})
      if (!by_modes && command.given(flag))
        throw UsageError(flag, "belongs to modal superposition; add --method modal");
    for (const char* flag : {"--elements", "--mass-matrix", "--fe-frequencies"})
      if (command.given(flag) && !(by_modes && modes_from == ModesFrom::fe))
        throw UsageError(flag, "belongs to finite elements; add --method modal --modes-from fe");
    if (by_modes && modes_from == ModesFrom::fe && !elements)
      throw UsageError("--elements", "is required with --modes-from fe");
    if (frequencies == FeFrequencies::corrected && mass_matrix != MassMatrix::lumped)
      throw UsageError("--fe-frequencies", "the correction is that of the lumped mass matrix");
    if (by_modes && body.far_end() == FarEnd::infinite)
      throw UsageError("--far-end", "an infinite bar has no modes; use its travelling waves (--method wave)");
    modal.require_consistent(command);
  }

  void require_modes_in(const Bar& bar, const BarMesh& mesh) const {
    const std::size_t held = bar.faces.size() == 1 && bar.far_end == FarEnd::fixed ? 1 : 0;
    const std::size_t count = std::accumulate(mesh.elements.begin(), mesh.elements.end(), std::size_t{1}) - held;
    if (modal.mode_count() && *modal.mode_count() > count)
      throw UsageError("--modes",
                       fmt::format("{} modes are asked for, but {} elements have only {}; use more --elements",
                                   *modal.mode_count(), *elements, count));
  }

  [[nodiscard]] ModalModel modal_body(const Bar& bar) const {
    const std::size_t count = modal.mode_count().value_or(std::numeric_limits<std::size_t>::max());
    const double highest = modal.highest_frequency_Hz();
    if (modes_from == ModesFrom::exact) return exact_bar_modes(bar, {highest, count});
    const BarMesh mesh = bar_mesh_by_count(bar, *elements, mass_matrix);
    require_modes_in(bar, mesh);
    const ModalModel plain =
        modal_model(bar_structure(bar, mesh), {.mode_count = count, .highest_frequency_Hz = highest});
    return frequencies == FeFrequencies::plain ? plain : dispersion_corrected(plain, bar, mesh, highest);
  }
};

}  // namespace

int run_bar_tool(int argc, char** argv, ToolPage page, BarOptions::Kind kind) {
  Command command(std::move(page));
  Request request(kind);
  request.declare(command);
  return run_tool(argc, argv, command, [&] {
    request.require_consistent(command);
    const Bar bar = request.body.bar();
    if (request.method == Method::wave && !request.modal.wants_modes())
      request.modal.write(wave_response(bar, request.modal.grid()));
    else
      request.modal.write(request.modal_body(bar));
    return 0;
  });
}

}  // namespace impulse
