#include "lib/cli/laminate_options.hpp"
#include "lib/cli/run_tool.hpp"
#include "lib/csv/csv_output.hpp"

#include <fmt/format.h>

#include <array>

namespace {

using namespace impulse;

enum class Output { constants, plies };

class Table {
 public:
  explicit Table(const std::string& path) : output_(path, {"quantity", "value"}) {}
  void row(const std::string& quantity, double value) { output_.row({quantity, value}); }

  void symmetric(const std::string& letter, const Eigen::Matrix3d& matrix, const std::string& unit) {
    static constexpr std::array indices{1, 2, 6};
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index j = i; j < 3; ++j)
        row(fmt::format("{}{}{}_{}", letter, indices[static_cast<std::size_t>(i)], indices[static_cast<std::size_t>(j)],
                        unit),
            matrix(i, j));
  }

  void constants(const std::string& prefix, const EngineeringConstants& c) {
    row(prefix + "_Ex_Pa", c.modulus_x_Pa);
    row(prefix + "_Ey_Pa", c.modulus_y_Pa);
    row(prefix + "_Gxy_Pa", c.shear_modulus_xy_Pa);
    row(prefix + "_nu_xy", c.poissons_ratio_xy);
    row(prefix + "_nu_yx", c.poissons_ratio_yx);
    row(prefix + "_shear_coupling_x", c.shear_coupling_x);
    row(prefix + "_shear_coupling_y", c.shear_coupling_y);
  }

  void close() { output_.close(); }

 private:
  CsvOutput output_;
};

void write_constants(const std::string& path, const Laminate& laminate) {
  Table table(path);
  table.row("thickness_m", laminate.thickness_m);
  table.symmetric("A", laminate.extension, "N_per_m");
  table.symmetric("B", laminate.coupling, "N");
  table.symmetric("D", laminate.bending, "Nm");
  table.row("A44_N_per_m", laminate.transverse_shear(0, 0));
  table.row("A45_N_per_m", laminate.transverse_shear(0, 1));
  table.row("A55_N_per_m", laminate.transverse_shear(1, 1));
  table.row("I0_kg_per_m2", laminate.mass_kg_per_m2);
  table.row("I1_kg_per_m", laminate.mass_moment_kg_per_m);
  table.row("I2_kg", laminate.rotary_inertia_kg);
  const LaminateConstants constants = engineering_constants(laminate);
  table.constants("in_plane", constants.in_plane);
  table.constants("flexural", constants.flexural);
  table.close();
}

void write_plies(const std::string& path, const std::vector<Layer>& layers) {
  CsvOutput output(path, {"ply", "angle_deg", "bottom_m", "top_m"});
  double bottom = -laminate(layers).thickness_m / 2;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    output.row({static_cast<double>(i + 1), layers[i].angle_deg, bottom, bottom + layers[i].thickness_m});
    bottom += layers[i].thickness_m;
  }
  output.close();
}

}  // namespace

int main(int argc, char** argv) {
  Command command({"ir-laminate", "stiffness, inertia and engineering constants of a laminate",
                   "Classical lamination theory about the middle surface: A, B, D in the order x, y, xy (1, 2, 6) with "
                   "engineering shear strains; A44, A45, A55 the transverse shear stiffness (yz, xz) without a shear "
                   "correction factor; I0, I1, I2 the mass moments. in_plane constants are those of mean strains under "
                   "loads in the plane, flexural ones those of curvatures under moments, the other set of loads being "
                   "zero; shear_coupling is the shear strain per direct strain.",
                   "ir-laminate --layup '[0/45/0/-45/0]2s' --ply graphite-epoxy --thickness 2.69mm"});
  LaminateOptions options;
  Output as = Output::constants;
  std::string path;
  options.declare(command);
  command.choice<Output>("--as", as, {{"constants", Output::constants}, {"plies", Output::plies}},
                         "what to write: the laminate's constants, or the plies that the layup means");
  command.output(path);
  return run_tool(argc, argv, command, [&] {
    const std::vector<Layer> layers = options.layers();
    if (as == Output::plies)
      write_plies(path, layers);
    else
      write_constants(path, laminate(layers));
    return 0;
  });
}
