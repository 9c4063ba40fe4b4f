#include "lib/cli/laminate_options.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace impulse;

namespace {

std::vector<Layer> layers_from(std::vector<const char*> arguments) {
  Command command({"test", "", "", ""});
  LaminateOptions options;
  options.declare(command);
  arguments.insert(arguments.begin(), "test");
  (void)command.parse(static_cast<int>(arguments.size()), arguments.data());
  return options.layers();
}

}  // namespace

TEST_CASE("laminate options make layers") {
  const std::vector<Layer> panel =
      layers_from({"--layup", "[0/45/0/-45/0]2s", "--ply", "graphite-epoxy", "--thickness", "2.69mm"});
  CHECK(panel.size() == 20);
  CHECK(panel[1].angle_deg == 45);
  CHECK(panel[1].thickness_m == about(1.345e-4).epsilon(1e-14));
  CHECK(layers_from({"--layup", "[0/90]", "--ply", "graphite-epoxy", "--ply-thickness", "0.1mm"})[1].thickness_m ==
        about(1e-4).epsilon(1e-14));
  CHECK(
      layers_from({"--layup", "[0/90]", "--ply", "graphite-epoxy", "--ply-thickness", "0.1mm", "--thickness", "0.2mm"})
          .size() == 2);
  const std::vector<Layer> steel = layers_from({"--material", "steel:0.3", "--thickness", "1cm"});
  CHECK(steel.size() == 1);
  CHECK(steel[0].ply.modulus_2_Pa == 206e9);
}

TEST_CASE("laminate options say what is missing, of no use or wrong") {
  struct Row {
    std::vector<const char*> arguments;
    const char* message;
  };
  for (const Row& row :
       {Row{{"--thickness", "1mm"}, "--layup: is required, with --ply (or --material for an isotropic plate)"},
        {{"--layup", "[0]", "--thickness", "1mm"}, "--ply: is required with --layup"},
        {{"--ply", "graphite-epoxy", "--thickness", "1mm"}, "--layup: is required with --ply; of a single ply"},
        {{"--layup", "[0]", "--ply", "graphite-epoxy"}, "--thickness: is required (or --ply-thickness)"},
        {{"--layup", "[0/x]", "--ply", "graphite-epoxy", "--thickness", "1mm"},
         "--layup: layup '[0/x]': column 4: expected an angle in degrees, not 'x'"},
        {{"--layup", "[0/90]s", "--ply", "graphite-epoxy", "--thickness", "1mm", "--ply-thickness", "0.2mm"},
         "--ply-thickness: 4 plies of 0.0002 m make 0.0008 m and do not fill the thickness of 0.001 m"},
        {{"--material", "steel:0.3"}, "--thickness: is required"},
        {{"--material", "steel", "--thickness", "1mm"}, "--material: material 'steel' has no Poisson's ratio"},
        {{"--material", "steel:0.3", "--layup", "[0]", "--thickness", "1mm"}, "--layup: means nothing to an isotropic"},
        {{"--material", "steel:0.3", "--ply", "graphite-epoxy"}, "--ply: given beside --material"},
        {{"--material", "steel:0.3", "--ply-thickness", "1mm"}, "--ply-thickness: is of a ply"},
        {{"--ply", "carbon"}, "--ply: unknown ply 'carbon'"},
        {{"--material", "steel:0.6"}, "--material: Poisson's ratio 0.6 is outside (-1, 0.5)"}}) {
    CAPTURE(row.message);
    CHECK_THROWS_WITH((void)layers_from(row.arguments), doctest::Contains(row.message));
  }
}
