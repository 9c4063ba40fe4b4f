#include "tools/support/solid_body.hpp"

#include "lib/cli/blamed_on.hpp"
#include "lib/cli/config_toml.hpp"
#include "tools/support/solid_options.hpp"

#include <memory>

namespace impulse {

DescribedBody read_solid_body(const TomlFile& file) {
  SolidOptions options;
  read_config_file(file, [&](Command& command) { options.declare(command); });
  return blamed_on(file, [&] {
    const AxisymmetricSolid solid = options.solid(MassMatrix::lumped);
    const auto structure = std::make_shared<const Structure>(axisymmetric_structure(solid).structure);
    DescribedBody body;
    body.contact_count = static_cast<std::size_t>(structure->contacts.cols());
    if (options.is_free()) body.free_mass_kg = mass_kg(solid);
    body.divisible = Divisible::no;
    body.structure = [structure](const ExplicitMesh&) { return *structure; };
    return body;
  });
}

}  // namespace impulse
