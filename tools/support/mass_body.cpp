#include "tools/support/mass_body.hpp"

#include "fem/bodies/mass_structure.hpp"
#include "lib/cli/command.hpp"

namespace impulse {

DescribedBody read_mass_body(const TomlFile& file) {
  double mass = 0;
  read_config_file(file, [&](Command& command) {
    command.body("mass");
    command.quantity("--mass", mass, "kg", Sign::positive, "mass").required();
  });
  DescribedBody body;
  body.free_mass_kg = body.rigid_mass_kg = mass;
  body.divisible = Divisible::no;
  body.structure = [mass](const ExplicitMesh&) { return mass_structure(mass); };
  return body;
}

}  // namespace impulse
