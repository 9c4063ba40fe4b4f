#include "tools/support/beam_body.hpp"

#include "lib/cli/blamed_on.hpp"
#include "lib/cli/config_toml.hpp"
#include "tools/support/beam_options.hpp"

#include <utility>

namespace impulse {

DescribedBody read_beam_body(const TomlFile& file) {
  BeamOptions options;
  read_config_file(file, [&](Command& command) { options.declare(command); });
  const auto [beam, model] = blamed_on(file, [&] { return std::pair{options.beam(), options.model()}; });
  DescribedBody body;
  body.contact_count = beam.contacts_at.size();
  if (beam.supports == BeamSupports::free) body.free_mass_kg = beam.mass_kg();
  body.structure = [beam = beam, model = model](const ExplicitMesh& mesh) {
    return beam_structure(beam, model,
                          mesh.element_count ? beam_mesh_by_count(beam, model, *mesh.element_count, MassMatrix::lumped)
                                             : beam_mesh_by_step(beam, model, mesh.step_s));
  };
  return body;
}

}  // namespace impulse
