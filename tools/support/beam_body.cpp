#include "tools/support/beam_body.hpp"

#include "lib/cli/config_toml.hpp"
#include "lib/contract/errors.hpp"
#include "tools/support/beam_options.hpp"

#include <string_view>

namespace impulse {

DescribedBody read_beam_body(const TomlFile& file) {
  BeamOptions options;
  read_config_file(file, [&](Command& command) { options.declare(command); });
  Beam beam;
  BeamModel model;
  try {
    beam = options.beam();
    model = options.model();
  } catch (const std::exception& error) {
    const std::string_view message = error.what();
    throw InputError(file.name, 0, 0, std::string(message.substr(message.starts_with("--") ? 2 : 0)));
  }
  DescribedBody body;
  body.contact_count = beam.contacts_at.size();
  if (beam.supports == BeamSupports::free) body.free_mass_kg = beam.mass_kg();
  body.structure = [beam, model](const ExplicitMesh& mesh) {
    return beam_structure(beam, model,
                          mesh.element_count ? beam_mesh_by_count(beam, model, *mesh.element_count, MassMatrix::lumped)
                                             : beam_mesh_by_step(beam, model, mesh.step_s));
  };
  return body;
}

}  // namespace impulse
