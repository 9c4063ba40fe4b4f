#include "tools/support/bar_tool.hpp"

#include "fem/bodies/bar_structure.hpp"
#include "fem/bodies/dispersion_correction.hpp"
#include "impulse/exact/bar_modes.hpp"
#include "impulse/response/modal_response.hpp"
#include "impulse/response/response_csv.hpp"
#include "impulse/response/wave_response.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/contract/errors.hpp"

#include <fmt/format.h>

#include <numeric>

namespace impulse {
namespace {

enum class Output { response, modes };
enum class Method { wave, modal };
enum class ModesFrom { exact, fe };

struct Request {
  explicit Request(BarOptions::Kind kind) : body(kind) {}

  BarOptions body;
  Output as = Output::response;
  Method method = Method::wave;
  ModesFrom modes_from = ModesFrom::exact;
  std::optional<double> step_s;
  std::optional<double> duration_s;
  std::optional<std::size_t> elements;
  std::optional<std::size_t> modes;
  MassMatrix mass_matrix = MassMatrix::lumped;
  FeFrequencies frequencies = FeFrequencies::plain;
  std::string output;

  void declare(Command& command) {
    body.declare(command);
    command.quantity("--step", step_s, "s", Sign::positive, "time step of the response");
    command.quantity("--duration", duration_s, "s", Sign::positive, "duration; round(duration/step) + 1 samples");
    command.choice<Output>("--as", as, {{"response", Output::response}, {"modes", Output::modes}}, "what to write");
    command.choice<Method>("--method", method, {{"wave", Method::wave}, {"modal", Method::modal}},
                           "travelling waves (exact) or modal superposition");
    command.choice<ModesFrom>("--modes-from", modes_from, {{"exact", ModesFrom::exact}, {"fe", ModesFrom::fe}},
                              "modes of the continuous bar, or of its finite elements");
    command.count("--modes", modes, 1,
                  "number of modes, the rigid-body mode included (default: up to the step's Nyquist frequency)");
    command.count("--elements", elements, 1, "finite elements along the bar, shared out by travel time");
    command.choice<MassMatrix>("--mass-matrix", mass_matrix,
                               {{"lumped", MassMatrix::lumped}, {"consistent", MassMatrix::consistent}},
                               "of the finite elements");
    command.choice<FeFrequencies>("--fe-frequencies", frequencies,
                                  {{"plain", FeFrequencies::plain}, {"corrected", FeFrequencies::corrected}},
                                  "corrected: freed of the lumped mesh's dispersion");
    command.output(output);
  }

  void require_consistent(const Command& command) const {
    const bool modal = method == Method::modal || as == Output::modes;
    if (as == Output::modes && command.given("--method") && method == Method::wave)
      throw UsageError("--method", "travelling waves have no modes; leave it out with --as modes");
    if (as == Output::modes && command.given("--duration"))
      throw UsageError("--duration", "modes have no duration; leave it out with --as modes");
    for (const char* flag : {"--modes", "--modes-from"})
      if (!modal && command.given(flag)) throw UsageError(flag, "belongs to modal superposition; add --method modal");
    for (const char* flag : {"--elements", "--mass-matrix", "--fe-frequencies"})
      if (command.given(flag) && !(modal && modes_from == ModesFrom::fe))
        throw UsageError(flag, "belongs to finite elements; add --method modal --modes-from fe");
    if (modal && modes_from == ModesFrom::fe && !elements)
      throw UsageError("--elements", "is required with --modes-from fe");
    if (frequencies == FeFrequencies::corrected && mass_matrix != MassMatrix::lumped)
      throw UsageError("--fe-frequencies", "the correction is that of the lumped mass matrix");
    if (modal && body.far_end() == FarEnd::infinite)
      throw UsageError("--far-end", "an infinite bar has no modes; use its travelling waves (--method wave)");
    if (as == Output::modes && step_s && modes)
      throw UsageError("--step", "sets the number of modes, which --modes gives; leave one of them out");
    if (as == Output::response && !step_s) throw UsageError("--step", "is required for a response");
    if (as == Output::response && !duration_s) throw UsageError("--duration", "is required for a response");
    if (as == Output::modes && !step_s && !modes)
      throw UsageError("--modes", "is required with --as modes (or --step, for the modes up to its Nyquist frequency)");
  }

  /// Highest frequency wanted; a mode on the Nyquist frequency to rounding is wanted.
  [[nodiscard]] double highest_frequency_Hz() const {
    return modes ? std::numeric_limits<double>::infinity() : (0.5 + 1e-9) / *step_s;
  }
  [[nodiscard]] std::size_t mode_count() const { return modes.value_or(std::numeric_limits<std::size_t>::max()); }

  void require_modes_in(const Bar& bar, const BarMesh& mesh) const {
    const std::size_t held = bar.faces.size() == 1 && bar.far_end == FarEnd::fixed ? 1 : 0;
    const std::size_t count = std::accumulate(mesh.elements.begin(), mesh.elements.end(), std::size_t{1}) - held;
    if (modes && *modes > count)
      throw UsageError("--modes",
                       fmt::format("{} modes are asked for, but {} elements have only {}; use more --elements", *modes,
                                   *elements, count));
  }

  [[nodiscard]] ModalModel modal_body(const Bar& bar) const {
    if (modes_from == ModesFrom::exact) return exact_bar_modes(bar, {highest_frequency_Hz(), mode_count()});
    const BarMesh mesh = bar_mesh_by_count(bar, *elements, mass_matrix);
    require_modes_in(bar, mesh);
    const ModalModel plain = modal_model(bar_structure(bar, mesh),
                                         {.mode_count = mode_count(), .highest_frequency_Hz = highest_frequency_Hz()});
    return frequencies == FeFrequencies::plain ? plain : dispersion_corrected(plain, bar, mesh, highest_frequency_Hz());
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
    if (request.as == Output::modes) {
      write_modes(request.output, request.modal_body(bar));
      return 0;
    }
    const UniformGrid grid = grid_over(*request.duration_s, *request.step_s);
    write_response(request.output, request.method == Method::wave ? wave_response(bar, grid)
                                                                  : modal_response(request.modal_body(bar), grid));
    return 0;
  });
}

}  // namespace impulse
