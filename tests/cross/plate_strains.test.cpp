// Strains beside a point force: the Ritz plate and the shell, each against the exact series and against the other.
#include "fem/shell/shell.hpp"
#include "impulse/bodies/missing_answer.hpp"
#include "impulse/exact/plate_statics.hpp"
#include "lib/numerics/dense_algebra.hpp"
#include "tests/support/shells.hpp"

#include <doctest/doctest.h>

#include <Eigen/SparseCholesky>

#include <cmath>
#include <string>
#include <vector>

using namespace impulse;

namespace {

constexpr double length = 0.2286, width = 0.1016;  // 9 in x 4 in

struct Panel {
  std::string layup;
  std::string edges;
  double radius_m = 0;
};

Laminate laminate_of(const Panel& panel) {
  return laminate(layers_of(panel.layup, {"carbon", 137.9e9, 8.963e9, 0.3, 5.998e9, 5.998e9, 3.516e9, 1600}, 2.032e-3));
}

/// Deflection, strains of the middle surface and curvatures at a point (fractions) under 1 N in the middle.
using Answer = Eigen::Matrix<double, 7, 1>;

Answer by_ritz(const Panel& panel, std::size_t terms, const Eigen::Vector2d& at) {
  Plate plate;
  plate.shape = rectangle(length, width);
  plate.laminate = laminate_of(panel);
  plate.edges = parse_plate_edges(panel.edges);
  plate.theory = Plate::Theory::thin;
  if (panel.radius_m != 0) plate.curvature_per_m = 1 / panel.radius_m;
  const RitzPlate ritz(plate, terms);
  const DenseStructure body = ritz.structure();
  const MissingAnswer missing(ritz, body, {{0, 0}});
  const Eigen::VectorXd u = DenseCholesky::of(body.stiffness)->solve(ritz.deflection({0, 0}));
  const Eigen::Vector2d point = 2 * at - Eigen::Vector2d::Ones();
  const auto strains = [&](double z) -> Eigen::Vector3d {
    return ritz.strains(point, z).transpose() * u + missing.strains(point, z);
  };
  const double z = 1e-3;
  Answer result;
  result << ritz.deflection(point).dot(u) + missing.deflection(point)(0), strains(0), (strains(z) - strains(0)) / z;
  return result;
}

Answer by_shell(const Panel& panel, std::size_t along_x, std::size_t along_y, const Eigen::Vector2d& at) {
  const PanelShape shape{.length_m = length,
                         .width_m = width,
                         .curvature = panel.radius_m == 0 ? Curvature::flat : Curvature::along_y,
                         .radius_m = panel.radius_m};
  const Shell shell(shells::panel(shape, laminate_of(panel), panel.edges, along_x, along_y));
  const Structure body = shell_structure(shell, {{length / 2, width / 2}});
  const Eigen::VectorXd u =
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(body.stiffness).solve(Eigen::VectorXd(body.contacts.col(0)));
  const PanelPoint point{at.x() * length, at.y() * width};
  const ShellStrain strain = shell.small_strain(u, point);
  Answer result;
  result << shell.normal(point).dot(shell.displacement(u, point)), strain.membrane, strain.curvature;
  return result;
}

}  // namespace

TEST_CASE("cross: strains beside a force on a specially orthotropic plate are Navier's by both methods") {
  const Eigen::Vector2d beside(0.4, 0.7);
  for (const char* layup : {"[0/90]s", "[90/0]s"}) {  // the stiff direction along x, and along y
    CAPTURE(layup);
    const Panel panel{layup, "WWWW"};
    const PlateStatics exact = simply_supported_plate_statics(
        laminate_of(panel), length, width, {length / 2, width / 2}, {beside.x() * length, beside.y() * width});
    const auto error = [&](const Answer& a) {
      return std::max(std::abs(a(0) / exact.deflection_m_per_N - 1),
                      (a.tail<3>() - exact.curvature_per_Nm).norm() / exact.curvature_per_Nm.norm());
    };
    CHECK(error(by_ritz(panel, 18, beside)) < 1e-3);  // the stiff way along the short side has its images nearest
    // Second derivatives of cubics: the mesh leaves h² of them.
    const double coarse = error(by_shell(panel, 16, 8, beside));
    CHECK(coarse < 0.02);
    CHECK(error(by_shell(panel, 32, 16, beside)) < coarse / 3);
  }
}

TEST_SUITE("slow") {
  TEST_CASE("cross: strains of anisotropic flat and curved panels by Ritz series and by shell elements") {
    // Strains along x, along y and in shear differ from each other, so that no exchange of axes or signs would pass;
    // the membrane's share is there wherever the panel is curved, with coupling B in the last.
    for (const Panel& panel :
         {Panel{"[45/0/-45/90]2s", "IIII"}, Panel{"[30]", "IIII"}, Panel{"[45/0/-45/90]2s", "IIII", 1.524},
          Panel{"[45/0/-45/90]2s", "CCCC", 0.381}, Panel{"[30]", "IIII", -0.381}, Panel{"[30/-60]", "IIII", 0.6}}) {
      for (const Eigen::Vector2d& at : {Eigen::Vector2d(0.5, 0.75), Eigen::Vector2d(0.4, 0.7)}) {
        CAPTURE(panel.layup);
        CAPTURE(panel.radius_m);
        const Answer ritz = by_ritz(panel, 20, at), shell = by_shell(panel, 32, 16, at),
                     coarse_ritz = by_ritz(panel, 12, at), coarse_shell = by_shell(panel, 16, 8, at);
        const Answer apart = ritz - shell, coarse = coarse_ritz - coarse_shell;
        CHECK(std::abs(apart(0)) < 2e-3 * shell(0));
        CHECK(apart.tail<3>().norm() < 0.03 * shell.tail<3>().norm());  // what this mesh leaves at a node
        CHECK(apart.tail<3>().norm() < 0.5 * coarse.tail<3>().norm());
        if (panel.radius_m == 0) continue;
        CHECK(apart.segment<3>(1).norm() < 0.03 * shell.segment<3>(1).norm());
        CHECK(apart.segment<3>(1).norm() < coarse.segment<3>(1).norm());
      }
    }
  }
}
