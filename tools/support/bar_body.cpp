#include "tools/support/bar_body.hpp"

#include "fem/bodies/bar_structure.hpp"
#include "lib/cli/bar_options.hpp"

namespace impulse {

DescribedBody read_bar_body(const TomlFile& file) {
  const Bar bar = read_bar_file(file);
  DescribedBody body;
  body.contact_count = bar.faces.size();
  if (bar.far_end == FarEnd::free) body.free_mass_kg = mass_kg(bar.profile);
  body.structure = [bar](const ExplicitMesh& mesh) {
    return bar_structure(
        bar, mesh.element_count ? bar_mesh_by_count(bar, *mesh.element_count) : bar_mesh_by_step(bar, mesh.step_s));
  };
  return body;
}

}  // namespace impulse
