#include "fem/elements/plane_stress.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <stdexcept>

using namespace impulse;

namespace {

const Quadrilateral kinds[] = {Quadrilateral::bilinear, Quadrilateral::incompatible};

Material steel() { return parse_material("200GPa:8000kg/m3:0.3"); }

QuadrilateralCorners distorted() {
  QuadrilateralCorners corners;
  corners << 0.1, -0.2, 2.3, 0.3, 1.9, 1.7, -0.4, 0.9;
  return corners;
}

QuadrilateralCorners rectangle(double length, double height) {
  QuadrilateralCorners corners;
  corners << 0, 0, length, 0, length, height, 0, height;
  return corners;
}

/// Corner displacements of u = (a + bx + cy, d + ex + fy).
Eigen::Matrix<double, 8, 1> linear_field(const QuadrilateralCorners& corners,
                                         const Eigen::Matrix<double, 2, 3>& field) {
  Eigen::Matrix<double, 8, 1> u;
  for (Eigen::Index i = 0; i < 4; ++i) u.segment<2>(2 * i) = field * Eigen::Vector3d{1, corners(i, 0), corners(i, 1)};
  return u;
}

double area(const QuadrilateralCorners& c) {
  return 0.5 * std::abs((c(2, 0) - c(0, 0)) * (c(3, 1) - c(1, 1)) - (c(3, 0) - c(1, 0)) * (c(2, 1) - c(0, 1)));
}

}  // namespace

TEST_CASE("plane_stress: rigid motion strains neither kind, and only the three rigid motions") {
  for (const Quadrilateral kind : kinds) {
    const QuadrilateralMatrix k = plane_stress_stiffness(distorted(), steel(), 0.02, kind);
    CHECK((k - k.transpose()).norm() < 1e-15 * k.norm());
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<QuadrilateralMatrix>(k).eigenvalues();
    CHECK(values.head(3).cwiseAbs().maxCoeff() < 1e-13 * values(7));
    CHECK(values(3) > 1e-3 * values(7));
    using Field = Eigen::Matrix<double, 2, 3>;
    for (const Field& field : {Field{{1, 0, 0}, {0, 0, 0}}, Field{{0, 0, 0}, {1, 0, 0}}, Field{{0, 0, -1}, {0, 1, 0}}})
      CHECK((k * linear_field(distorted(), field)).norm() < 1e-13 * k.norm());
  }
}

TEST_CASE("plane_stress: the patch test, constant strain on a distorted element has the exact energy and forces") {
  const Material material = steel();
  const double t = 0.02, e = 200e9, nu = 0.3;
  for (const Quadrilateral kind : kinds) {
    const QuadrilateralMatrix k = plane_stress_stiffness(distorted(), material, t, kind);
    for (const Eigen::Vector3d& strain : {Eigen::Vector3d{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.3, -0.7, 0.4}}) {
      const Eigen::Matrix<double, 2, 3> field{{0, strain(0), strain(2)}, {0, 0, strain(1)}};
      const Eigen::Matrix<double, 8, 1> u = linear_field(distorted(), field);
      Eigen::Matrix3d d;
      d << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
      const double density = e / (1 - nu * nu) * strain.dot(d * strain);
      CHECK(u.dot(k * u) == about(density * t * area(distorted())).epsilon(1e-12));
      // Forces of the two kinds agree: the incompatible modes stay at rest.
      const QuadrilateralMatrix other = plane_stress_stiffness(distorted(), material, t, Quadrilateral::bilinear);
      CHECK((k * u - other * u).norm() < 1e-12 * (other * u).norm());
    }
  }
}

TEST_CASE("plane_stress: a rectangle in pure bending, exact with incompatible modes, too stiff without") {
  // u = xy, v = -x²/2 - νy²/2 about the centre; on the corners of an l × h element the hourglass field u = ±.
  const double l = 1.5, h = 0.4, t = 0.02, e = 200e9, nu = 0.3;
  Eigen::Matrix<double, 8, 1> u = Eigen::Matrix<double, 8, 1>::Zero();
  u(0) = u(4) = 1;
  u(2) = u(6) = -1;
  const auto energy = [&](Quadrilateral kind) {
    return u.dot(plane_stress_stiffness(rectangle(l, h), steel(), t, kind) * u);
  };
  // Curvature κ = 4/(lh) with u = ±1 = κ(l/2)(h/2): 2·energy = EIκ²l.
  const double kappa = 4 / (l * h);
  const double exact = e * t * h * h * h / 12 * kappa * kappa * l;
  CHECK(energy(Quadrilateral::incompatible) == about(exact).epsilon(1e-12));
  // Shear locking of the plain element in closed form: 1/(1-ν²) + (1-ν)/(2(1-ν²))·(l/h)².
  CHECK(energy(Quadrilateral::bilinear) ==
        about(exact * (1 + (1 - nu) / 2 * l * l / (h * h)) / (1 - nu * nu)).epsilon(1e-12));
}

TEST_CASE("plane_stress: masses weigh the element, about its centre too") {
  const QuadrilateralCorners corners = distorted();
  const double expected = 8000 * 0.02 * area(corners);
  const QuadrilateralMatrix m = plane_stress_consistent_mass(corners, 8000, 0.02);
  const Eigen::Vector4d nodal = plane_stress_lumped_mass(corners, 8000, 0.02);
  CHECK(m.sum() == about(2 * expected));
  CHECK(nodal.sum() == about(expected));
  for (Eigen::Index i = 0; i < 4; ++i) CHECK(nodal(i) == about(m.row(2 * i).sum()));
  // A rectangle's: ρt·area/36 [4 2 1 2].
  const QuadrilateralMatrix r = plane_stress_consistent_mass(rectangle(3, 2), 5, 0.5);
  CHECK(r(0, 0) == about(15 * 4.0 / 36));
  CHECK(r(0, 2) == about(15 * 2.0 / 36));
  CHECK(r(0, 4) == about(15 * 1.0 / 36));
  CHECK(r(0, 1) == 0);
}

TEST_CASE("plane_stress: refuses corners that are no convex quadrilateral and materials without Poisson's ratio") {
  QuadrilateralCorners clockwise = rectangle(1, 1);
  clockwise.row(1).swap(clockwise.row(3));
  QuadrilateralCorners concave = rectangle(1, 1);
  concave.row(2) << 0.2, 0.2;
  for (const QuadrilateralCorners& corners : {clockwise, concave}) {
    CHECK_THROWS_WITH_AS((void)plane_stress_stiffness(corners, steel(), 1, Quadrilateral::bilinear),
                         doctest::Contains("is not convex and counter-clockwise"), std::invalid_argument);
    CHECK_THROWS_AS((void)plane_stress_consistent_mass(corners, 1, 1), std::invalid_argument);
    CHECK_THROWS_AS((void)plane_stress_lumped_mass(corners, 1, 1), std::invalid_argument);
  }
  Material none = steel();
  none.poissons_ratio.reset();
  CHECK_THROWS_WITH_AS((void)plane_stress_stiffness(rectangle(1, 1), none, 1, Quadrilateral::bilinear),
                       doctest::Contains("plane stress needs Poisson's ratio"), std::invalid_argument);
  Material wrong = steel();
  wrong.poissons_ratio = 0.5;
  CHECK_THROWS_WITH_AS((void)plane_stress_stiffness(rectangle(1, 1), wrong, 1, Quadrilateral::bilinear),
                       "Poisson's ratio 0.5 is outside (-1, 0.5)", std::invalid_argument);
}
