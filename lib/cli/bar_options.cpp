#include "lib/cli/bar_options.hpp"

#include "lib/cli/blamed_on.hpp"
#include "lib/cli/config_toml.hpp"
#include "lib/contract/errors.hpp"

#include <fmt/format.h>

namespace impulse {

void BarOptions::declare(Command& command) {
  if (kind_ == Kind::chain) {
    command.body("bar");
    command
        .parsed<Segment>("--segment", segments_, parse_segment, "L,D[,D2],MATERIAL",
                         "cylinder L,D,MATERIAL or cone L,D1,D2,MATERIAL; repeat from end A to end B")
        .required();
  } else {
    command.body("cone");
    command.quantity("--length", length_m_, "m", Sign::positive, "length of the cone").required();
    command.quantity("--diameters", diameters_m_, "m", Sign::positive, "diameters at end A and end B: D1,D2")
        .required();
    command
        .parsed<Material>("--material", material_, parse_material, "MATERIAL",
                          "a name (steel, aluminium, nylon-6) or E:rho[:nu], 2.8GPa:1150kg/m3:0.40")
        .required();
  }
  command
      .choice<Face>("--face", faces_, {{"A", Face::a}, {"B", Face::b}},
                    "end that is struck; A,B for both (2x2 response)")
      .required();
  command.choice<FarEnd>("--far-end", far_end_,
                         {{"free", FarEnd::free}, {"fixed", FarEnd::fixed}, {"infinite", FarEnd::infinite}},
                         "what holds the other end; infinite: it goes on for ever with its end section");
}

Bar BarOptions::bar() const {
  Bar bar{segments_, faces_, far_end_};
  if (kind_ == Kind::cone) {
    if (diameters_m_.size() != 2)
      throw UsageError("--diameters", fmt::format("{} given, two are needed: 30mm,75mm", diameters_m_.size()));
    bar.profile = {{length_m_, diameters_m_[0], diameters_m_[1], *material_}};
  }
  if (bar.faces.size() > 2 || (bar.faces.size() == 2 && bar.faces[0] == bar.faces[1]))
    throw UsageError("--face", "a bar has two faces; give A, B or A,B");
  if (bar.faces.size() == 2 && bar.far_end != FarEnd::free)
    throw UsageError("--far-end", "a bar in contact at both faces has no far end to hold; leave it free");
  require_valid(bar);
  return bar;
}

Bar read_bar_file(const std::string& path) { return read_bar_file(read_toml(path)); }

Bar read_bar_file(const TomlFile& file) {
  const std::string kind = body_kind(file);
  if (kind != "bar" && kind != "cone")
    throw InputError(file.name, 0, 0, fmt::format("body \"{}\" is not a bar or cone", kind));
  BarOptions options(kind == "bar" ? BarOptions::Kind::chain : BarOptions::Kind::cone);
  read_config_file(file, [&](Command& command) { options.declare(command); });
  return blamed_on(file, [&] { return options.bar(); });
}

}  // namespace impulse
