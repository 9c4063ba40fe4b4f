#include "tools/support/mass_body.hpp"

#include "fem/bodies/mass_structure.hpp"
#include "lib/cli/mass_options.hpp"

namespace impulse {

DescribedBody read_mass_body(const TomlFile& file) {
  MassOptions options;
  read_config_file(file, [&](Command& command) { options.declare(command); });
  options.require_valid();
  DescribedBody body;
  body.free_mass_kg = body.rigid_mass_kg = options.mass_kg;
  body.contact_count = options.faces.size();
  body.divisible = Divisible::no;
  body.structure = [options](const ExplicitMesh&) { return mass_structure(options.mass_kg, options.faces); };
  return body;
}

}  // namespace impulse
