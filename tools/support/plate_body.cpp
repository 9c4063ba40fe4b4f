#include "tools/support/plate_body.hpp"

#include "fem/bodies/modal_structure.hpp"
#include "lib/cli/blamed_on.hpp"
#include "lib/cli/config_toml.hpp"
#include "lib/contract/errors.hpp"
#include "lib/model/modal_model.hpp"
#include "tools/support/plate_options.hpp"

#include <numbers>

namespace impulse {

DescribedBody read_plate_body(const TomlFile& file) {
  PlateOptions options;
  read_config_file(file, [&](Command& command) { options.declare(command); });
  const DenseStructure plate = blamed_on(file, [&] {
    if (options.point_count() == 0) throw UsageError("--at", "is required");
    return options.struck(options.plate()).structure;
  });
  DescribedBody body;
  body.contact_count = options.point_count();
  body.divisible = Divisible::no;
  body.structure = [structure = plate](const ExplicitMesh& mesh) {
    // Central differences see modes up to ω Δt = 1 (modal_structure).
    const ModalModel modes = modal_model(structure, {.highest_frequency_Hz = 1 / (2 * std::numbers::pi * mesh.step_s),
                                                     .residual = ModalOptions::Residual::attached});
    return modal_structure(modes, mesh.step_s);
  };
  return body;
}

}  // namespace impulse
