#include "lib/cli/laminate_options.hpp"

#include "lib/contract/errors.hpp"
#include "lib/material/layup.hpp"

#include <fmt/format.h>

#include <cmath>

namespace impulse {

void LaminateOptions::declare(Command& command) {
  command.text("--layup", layup_, "LAYUP",
               "fibre angles from the x axis in degrees, [+-45/0_2/90]s or [0/45/0/-45/0]2s, from z = -h/2 on");
  command.parsed<Ply>("--ply", ply_, parse_ply, "PLY",
                      "a name (graphite-epoxy, as4-3502:1600kg/m3) or E1:E2:nu12:G12:G13:G23:rho");
  command.parsed<Material>("--material", material_, parse_material, "MATERIAL",
                           "isotropic, in place of --layup and --ply: steel:0.3 or E:rho:nu");
  command.quantity("--thickness", thickness_m_, "m", Sign::positive, "total thickness");
  command.quantity("--ply-thickness", ply_thickness_m_, "m", Sign::positive, "of each ply, in place of --thickness");
}

double LaminateOptions::total_thickness_m(std::size_t ply_count) const {
  if (!ply_thickness_m_) return *thickness_m_;
  const double filled = *ply_thickness_m_ * static_cast<double>(ply_count);
  if (thickness_m_ && std::abs(filled - *thickness_m_) > 1e-6 * filled)
    throw UsageError("--ply-thickness",
                     fmt::format("{} plies of {:.6g} m make {:.6g} m and do not fill the thickness of "
                                 "{:.6g} m; leave --thickness or --ply-thickness out",
                                 ply_count, *ply_thickness_m_, filled, *thickness_m_));
  return filled;
}

std::vector<Layer> LaminateOptions::layers() const {
  if (material_) {
    if (layup_) throw UsageError("--layup", "means nothing to an isotropic --material; give --ply in its place");
    if (ply_) throw UsageError("--ply", "given beside --material; leave one of them out");
    if (ply_thickness_m_) throw UsageError("--ply-thickness", "is of a ply; an isotropic --material has a --thickness");
    if (!thickness_m_) throw UsageError("--thickness", "is required");
    try {
      return {{isotropic_ply(*material_), 0, *thickness_m_}};
    } catch (const std::invalid_argument& error) {
      throw UsageError("--material", error.what());
    }
  }
  if (!layup_ && !ply_) throw UsageError("--layup", "is required, with --ply (or --material for an isotropic plate)");
  if (!layup_) throw UsageError("--layup", "is required with --ply; of a single ply it reads [0]");
  if (!ply_) throw UsageError("--ply", "is required with --layup");
  if (!thickness_m_ && !ply_thickness_m_) throw UsageError("--thickness", "is required (or --ply-thickness)");
  try {
    const std::size_t count = parse_layup(*layup_).size();
    return layers_of(*layup_, *ply_, total_thickness_m(count));
  } catch (const std::invalid_argument& error) {
    throw UsageError("--layup", error.what());
  }
}

}  // namespace impulse
