#include "tools/support/solid_options.hpp"

#include "fem/mesh/msh_file.hpp"
#include "fem/mesh/solid_mesh.hpp"
#include "lib/cli/blamed_on.hpp"
#include "lib/contract/errors.hpp"

#include <fmt/format.h>

#include <utility>

namespace impulse {

void SolidOptions::declare(Command& command) {
  command.body("solid");
  command.parsed<Segment>(
      "--segment", segments_, parse_segment, "L,D[,D2],MATERIAL",
      "cylinder L,D,MATERIAL or cone L,D1,D2,MATERIAL; repeat from end A to end B; the material with "
      "its Poisson's ratio: nylon-6:0.40");
  command.text("--mesh", mesh_, "FILE.msh",
               "Gmsh mesh of the half section instead of segments: x = r, y = z, second-order triangles; face A is at "
               "the least z");
  command.parsed<Material>("--material", materials_, parse_material, "MATERIAL",
                           "with --mesh: of each physical surface, in the order of their tags");
  command
      .choice<Face>("--face", faces_, {{"A", Face::a}, {"B", Face::b}},
                    "end that is struck; A,B for both (2x2 response)")
      .required();
  command.choice<EndSupport>("--far-end", far_end_, {{"free", EndSupport::free}, {"fixed", EndSupport::fixed}},
                             "what holds the other end");
  command.quantity("--contact-radius", contact_radius_m_, "m", Sign::positive, "radius of the circle of contact")
      .required();
  command
      .choice<CircleContact>(
          "--contact", contact_,
          {{"punch", CircleContact::punch}, {"pressure", CircleContact::pressure}, {"nodes", CircleContact::nodes}},
          "force on the circle: by a rigid flat, spread uniformly, or at each node by itself "
          "(from the axis outwards; matrix response)")
      .required();
  command.quantity("--mesh-size", mesh_size_m_, "m", Sign::positive,
                   "of the elements at the edge of the circle (default: 1/20 of its radius)");
  command.quantity("--growth", growth_, "1", Sign::positive,
                   "elements at a distance d from the edge are larger by (growth - 1) d (default: 1.2)");
  command.quantity("--largest-per-radius", largest_per_radius_, "1", Sign::positive,
                   "but no larger than this part of the body's radius there (default: 0.25)");
}

TriangleMesh SolidOptions::mesh() const {
  if (mesh_) return read_msh(*mesh_);
  std::vector<MeshedCircle> circles;
  for (const Face face : faces_)
    circles.push_back({face, contact_radius_m_, mesh_size_m_.value_or(contact_radius_m_ / 20)});
  blamed_on("--contact-radius", [&] { require_circles(segments_, circles); });
  SolidMeshOptions options;
  options.growth = growth_.value_or(options.growth);
  if (!(options.growth > 1))
    throw UsageError("--growth", fmt::format("{} is not above 1, so that elements would not grow", options.growth));
  options.largest_per_radius = largest_per_radius_.value_or(options.largest_per_radius);
  return solid_mesh(segments_, circles, options);
}

std::vector<AxisymmetricElasticity> SolidOptions::materials() const {
  std::vector<AxisymmetricElasticity> all;
  if (mesh_)
    for (const Material& material : materials_) all.push_back(isotropic_elasticity(material));
  else
    for (const Segment& segment : segments_) all.push_back(isotropic_elasticity(segment.material));
  return all;
}

AxisymmetricSolid SolidOptions::solid(MassMatrix mass) const {
  if (mesh_.has_value() == !segments_.empty())
    throw UsageError(mesh_ ? "--mesh" : "--segment", "a solid is given by its segments or by a mesh, one of them");
  for (const auto& [flag, given] :
       {std::pair{"--mesh-size", mesh_size_m_}, {"--growth", growth_}, {"--largest-per-radius", largest_per_radius_}})
    if (mesh_ && given) throw UsageError(flag, "is for meshing segments; the mesh is given");
  if (mesh_.has_value() == materials_.empty())
    throw UsageError("--material", mesh_ ? "is required with --mesh, one for each physical surface"
                                         : "goes with --mesh; segments name their own material");
  if (faces_.size() > 2 || (faces_.size() == 2 && faces_[0] == faces_[1]))
    throw UsageError("--face", "a solid has two faces; give A, B or A,B");
  if (faces_.size() == 2 && far_end_ != EndSupport::free)
    throw UsageError("--far-end", "a solid in contact at both faces has no far end to hold; leave it free");
  // Materials first: a missing Poisson's ratio is found sooner than a mesh is made.
  std::vector<AxisymmetricElasticity> elasticity =
      blamed_on(mesh_ ? "--material" : "--segment", [&] { return materials(); });
  AxisymmetricSolid solid{.mesh = mesh(), .materials = std::move(elasticity), .contacts = {}, .mass = mass};
  for (const Face face : faces_) {
    solid.contacts.push_back({face, contact_radius_m_, contact_});
    blamed_on("--contact-radius", [&] { require_circle(solid.mesh, solid.contacts.back()); });
  }
  if (faces_.size() == 1) (faces_[0] == Face::a ? solid.end_b : solid.end_a) = far_end_;
  return solid;
}

}  // namespace impulse
