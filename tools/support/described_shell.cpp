#include "tools/support/described_shell.hpp"

#include "lib/cli/blamed_on.hpp"
#include "lib/cli/config_toml.hpp"
#include "tools/support/shell_body.hpp"

#include <memory>

namespace impulse {

DescribedBody read_shell_body(const TomlFile& file) {
  ShellOptions options;
  read_config_file(file, [&](Command& command) { options.declare(command, ShellOptions::Use::impact); });
  return blamed_on(file, [&] {
    const Shell shell(options.panel());
    const auto structure = std::make_shared<const Structure>(shell_structure(shell, options.points()));
    DescribedBody body;
    body.contact_count = static_cast<std::size_t>(structure->contacts.cols());
    if (structure->translation.size() > 0)
      body.free_mass_kg = structure->translation.dot(structure->mass * structure->translation);
    body.divisible = Divisible::no;
    body.structure = [structure](const ExplicitMesh&) { return *structure; };
    return body;
  });
}

}  // namespace impulse
