#include "tools/support/beam_options.hpp"

#include "fem/bodies/plane_stress_beam.hpp"
#include "lib/cli/blamed_on.hpp"
#include "lib/contract/errors.hpp"

#include <string>

namespace impulse {

void BeamOptions::declare(Command& command) {
  command.body("beam");
  command.quantity("--length", length_m_, "m", Sign::positive, "length of the beam").required();
  command.quantity("--width", width_m_, "m", Sign::positive, "of the section, across the force").required();
  command.quantity("--height", height_m_, "m", Sign::positive, "of the section, along the force").required();
  command
      .parsed<Material>("--material", material_, parse_material, "MATERIAL",
                        "a name (steel, aluminium, nylon-6) or E:rho[:nu], 2.8GPa:1150kg/m3:0.40")
      .required();
  command
      .choice<BeamSupports>("--supports", supports_,
                            {{"simple", BeamSupports::simple},
                             {"clamped", BeamSupports::clamped},
                             {"cantilever", BeamSupports::cantilever},
                             {"free", BeamSupports::free}},
                            "what holds the ends; cantilever: the end at 0 is clamped")
      .required();
  command
      .quantity("--at", at_, "1", Sign::any,
                "where the beam is struck, as a fraction of its length; 0.5,0.25 for two "
                "points (2x2 response)")
      .required();
  command.choice<BeamElement>("--element", element_,
                              {{"hermite", BeamElement::hermite}, {"plane-stress", BeamElement::plane_stress}},
                              "finite elements: bending (no shear), or quadrilaterals through the height");
  command.choice<Quadrilateral>(
      "--quadrilateral", quadrilateral_,
      {{"bilinear", Quadrilateral::bilinear}, {"incompatible", Quadrilateral::incompatible}},
      "of plane stress: plain, which bends too stiffly, or with incompatible bending modes (default: bilinear)");
  command.quantity("--patch-length", patch_length_m_, "m", Sign::positive,
                   "of plane stress: length of the top face on which the force presses evenly, over the whole width");
}

Beam BeamOptions::beam() const {
  for (const double at : at_) {
    try {
      require_point(supports_, at);
    } catch (const std::invalid_argument& error) {
      throw UsageError("--at", error.what());
    }
  }
  const Beam beam{length_m_, width_m_, height_m_, *material_, supports_, at_};
  require_valid(beam);
  return beam;
}

BeamModel BeamOptions::model() const {
  BeamModel model;
  model.element = element_.value_or(BeamElement::hermite);
  if (model.element != BeamElement::plane_stress) {
    if (quadrilateral_) throw UsageError("--quadrilateral", "belongs to --element plane-stress");
    if (patch_length_m_) throw UsageError("--patch-length", "belongs to --element plane-stress");
    return model;
  }
  if (!patch_length_m_)
    throw UsageError("--patch-length",
                     "is required with --element plane-stress (under a line of force the displacement has no limit)");
  if (!material_->poissons_ratio)
    throw UsageError("--material", "plane stress needs Poisson's ratio; add it after a colon, as in steel:0.3");
  model.quadrilateral = quadrilateral_.value_or(Quadrilateral::bilinear);
  model.patch_length_m = *patch_length_m_;
  blamed_on("--patch-length", [&] { require_patches(beam(), model.patch_length_m); });
  return model;
}

}  // namespace impulse
