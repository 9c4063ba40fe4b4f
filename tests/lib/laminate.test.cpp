#include "lib/material/laminate.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <numbers>

using namespace impulse;

namespace {

const Ply ply{"test", 140e9, 9e9, 0.31, 5e9, 4e9, 3e9, 1600};

double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return (a - b).norm() / b.norm(); }

}  // namespace

TEST_CASE("an isotropic laminate has the stiffness of a plate, however it is cut") {
  const Material steel = parse_material("206GPa:7780kg/m3:0.3");
  const double h = 0.01, e = 206e9, nu = 0.3;
  for (const char* layup : {"[0]", "[0/30/-71]", "[13/90]s"}) {
    const Laminate plate = laminate(layers_of(layup, isotropic_ply(steel), h));
    Eigen::Matrix3d q;
    q << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
    q *= e / (1 - nu * nu);
    CHECK(difference(plate.extension, q * h) < 1e-14);
    CHECK(difference(plate.bending, q * h * h * h / 12) < 1e-14);
    CHECK(plate.coupling.norm() < 1e-14 * plate.extension.norm() * h);
    CHECK(difference(plate.transverse_shear, Eigen::Matrix2d::Identity() * e / 2.6 * h) < 1e-14);
    CHECK(plate.mass_kg_per_m2 == about(77.8).epsilon(1e-14));
    CHECK(std::abs(plate.mass_moment_kg_per_m) < 1e-15);
    CHECK(plate.rotary_inertia_kg == about(7780 * h * h * h / 12).epsilon(1e-14));
    for (const EngineeringConstants& c :
         {engineering_constants(plate).in_plane, engineering_constants(plate).flexural}) {
      CHECK(c.modulus_x_Pa == about(e).epsilon(1e-13));
      CHECK(c.modulus_y_Pa == about(e).epsilon(1e-13));
      CHECK(c.shear_modulus_xy_Pa == about(e / 2.6).epsilon(1e-13));
      CHECK(c.poissons_ratio_xy == about(nu).epsilon(1e-13));
      CHECK(std::abs(c.shear_coupling_x) < 1e-13);
    }
  }
}

TEST_CASE("D of the 20-ply panel") {
  // Independent computation, five digits.
  const Eigen::Matrix3d d = laminate(layers_of("[0/45/0/-45/0]2s", parse_ply("graphite-epoxy"), 0.00269)).bending;
  CHECK(std::abs(d(0, 0) - 144.29) < 0.005);
  CHECK(std::abs(d(0, 1) - 19.900) < 0.0005);
  CHECK(std::abs(d(1, 1) - 32.345) < 0.0005);
  CHECK(std::abs(d(2, 2) - 24.954) < 0.0005);
  CHECK(std::abs(d(0, 2) - 5.488) < 0.0005);
  CHECK(std::abs(d(1, 2) - 5.488) < 0.0005);
}

TEST_CASE("a single ply measured along its axes shows its own constants") {
  const EngineeringConstants along = engineering_constants(laminate(layers_of("[0]", ply, 1e-3))).in_plane;
  CHECK(along.modulus_x_Pa == about(140e9).epsilon(1e-13));
  CHECK(along.modulus_y_Pa == about(9e9).epsilon(1e-13));
  CHECK(along.shear_modulus_xy_Pa == about(5e9).epsilon(1e-13));
  CHECK(along.poissons_ratio_xy == about(0.31).epsilon(1e-13));
  CHECK(along.poissons_ratio_yx == about(0.31 * 9 / 140).epsilon(1e-13));
  const EngineeringConstants across = engineering_constants(laminate(layers_of("[90]", ply, 1e-3))).flexural;
  CHECK(across.modulus_x_Pa == about(9e9).epsilon(1e-13));
  CHECK(across.poissons_ratio_yx == about(0.31).epsilon(1e-13));
  const Laminate turned = laminate(layers_of("[90]", ply, 1e-3));
  CHECK(turned.extension(0, 2) == 0);  // exact, so that a cross-ply has no spurious coupling
  CHECK(turned.transverse_shear(0, 0) == about(4e6).epsilon(1e-14));
  CHECK(turned.transverse_shear(1, 1) == about(3e6).epsilon(1e-14));
}

TEST_CASE("off-axis constants of a ply are those of the textbook") {
  for (const double angle : {10.0, 30.0, 45.0, 72.0, -30.0}) {
    CAPTURE(angle);
    const double c = std::cos(angle * std::numbers::pi / 180), s = std::sin(angle * std::numbers::pi / 180);
    const double cross = 1 / ply.shear_modulus_12_Pa - 2 * ply.poissons_ratio_12 / ply.modulus_1_Pa;
    const double s11 = std::pow(c, 4) / ply.modulus_1_Pa + cross * c * c * s * s + std::pow(s, 4) / ply.modulus_2_Pa;
    const double s16 =
        2 * c * c * c * s / ply.modulus_1_Pa - 2 * c * s * s * s / ply.modulus_2_Pa + cross * c * s * (s * s - c * c);
    const EngineeringConstants k = engineering_constants(laminate({{ply, angle, 2e-3}})).in_plane;
    CHECK(k.modulus_x_Pa == about(1 / s11).epsilon(1e-12));
    CHECK(k.shear_coupling_x == about(s16 / s11).epsilon(1e-12));
    const Laminate one = laminate({{ply, angle, 2e-3}});
    CHECK(one.transverse_shear(0, 0) == about((c * c * 3e9 + s * s * 4e9) * 2e-3).epsilon(1e-13));
    CHECK(one.transverse_shear(0, 1) == about(c * s * (4e9 - 3e9) * 2e-3).epsilon(1e-13));
  }
}

TEST_CASE("turning all plies turns the tensors") {
  const auto stiffness = [](double by) {
    std::vector<Layer> layers = layers_of("[0/45/-20]", ply, 3e-3);
    for (Layer& layer : layers) layer.angle_deg += by;
    return laminate(layers);
  };
  const Laminate plain = stiffness(0), quarter = stiffness(90), half = stiffness(180);
  Eigen::Matrix3d swap;
  swap << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  CHECK(difference(quarter.coupling, swap * plain.coupling * swap) < 1e-14);
  CHECK(difference(quarter.bending, swap * plain.bending * swap) < 1e-14);
  CHECK(difference(half.coupling, plain.coupling) < 1e-14);
}

TEST_CASE("mass moments and coupling of two different layers") {
  Ply heavy = ply;
  heavy.density_kg_per_m3 = 3200;
  const Laminate plate = laminate({{ply, 0, 1e-3}, {heavy, 0, 2e-3}});  // z from -1.5 to -0.5 to 1.5 mm
  CHECK(plate.thickness_m == about(3e-3).epsilon(1e-15));
  CHECK(plate.mass_kg_per_m2 == about(1.6 + 6.4).epsilon(1e-14));
  CHECK(plate.mass_moment_kg_per_m == about(-1.6e-3 + 6.4 * 0.5e-3).epsilon(1e-13));
  CHECK(plate.rotary_inertia_kg == about((1600 * (3.375 - 0.125) + 3200 * (3.375 + 0.125)) / 3 * 1e-9).epsilon(1e-13));
  // [0/90]: B11 = h²/8 (Q22 - Q11), with the stiffer ply below.
  const Laminate cross = laminate(layers_of("[0/90]", ply, 2e-3));
  const double scale = 1 / (1 - 0.31 * 0.31 * 9 / 140);
  CHECK(cross.coupling(0, 0) == about(0.5e-6 * scale * (9e9 - 140e9)).epsilon(1e-13));
  CHECK(cross.coupling(1, 1) == about(-cross.coupling(0, 0)).epsilon(1e-13));
  CHECK(laminate(layers_of("[0/90]s", ply, 2e-3)).coupling.isZero(0));
  const Laminate many = laminate(layers_of("[(37/-11/80)20/±45]3s", ply, 7e-3));
  CHECK(many.coupling.isZero(0));
  CHECK(many.mass_moment_kg_per_m == 0);
}

TEST_CASE("laminate refuses what has no stiffness") {
  CHECK_THROWS_WITH((void)laminate({}), "a laminate without layers has no stiffness");
  CHECK_THROWS_WITH((void)laminate({{ply, 0, 0}}), doctest::Contains("thickness 0 m is not positive"));
  CHECK_THROWS_WITH((void)laminate({{ply, std::numeric_limits<double>::quiet_NaN(), 1}}), doctest::Contains("angle"));
  Ply soft = ply;
  soft.shear_modulus_23_Pa = 0;
  CHECK_THROWS_WITH((void)laminate({{soft, 0, 1}}), "ply 'test': shear modulus G23 0 is not positive and finite");
}
