#include "tools/support/solid_body.hpp"

#include "lib/cli/config_toml.hpp"
#include "lib/contract/errors.hpp"
#include "tools/support/solid_options.hpp"

#include <memory>

namespace impulse {

DescribedBody read_solid_body(const TomlFile& file) {
  SolidOptions options;
  read_config_file(file, [&](Command& command) { options.declare(command); });
  try {
    const AxisymmetricSolid solid = options.solid(MassMatrix::lumped);
    const auto structure = std::make_shared<const Structure>(axisymmetric_structure(solid).structure);
    DescribedBody body;
    body.contact_count = static_cast<std::size_t>(structure->contacts.cols());
    if (options.is_free()) body.free_mass_kg = mass_kg(solid);
    body.divisible = Divisible::no;
    body.structure = [structure](const ExplicitMesh&) { return *structure; };
    return body;
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    const std::string_view message = error.what();
    throw InputError(file.name, 0, 0, std::string(message.substr(message.starts_with("--") ? 2 : 0)));
  }
}

}  // namespace impulse
