#include "fem/elements/axisymmetric_triangle.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace impulse {
namespace {

constexpr double pi = std::numbers::pi;
const AxisymmetricElasticity steel = isotropic_elasticity({"steel", 206e9, 7780, 0.3});
const AxisymmetricElasticity fibres = transversely_isotropic_elasticity({120e9, 7.9e9, 0.3, 0.45, 5.5e9, 1580});

TriangleNodes straight(double r1, double z1, double r2, double z2, double r3, double z3) {
  TriangleNodes nodes;
  nodes << r1, z1, r2, z2, r3, z3, (r1 + r2) / 2, (z1 + z2) / 2, (r2 + r3) / 2, (z2 + z3) / 2, (r3 + r1) / 2,
      (z3 + z1) / 2;
  return nodes;
}

const TriangleNodes away = straight(1.0, 0.2, 1.9, 0.1, 1.3, 1.1);
const TriangleNodes corner_on_axis = straight(0, 0, 1, 0.1, 0.7, 0.9);
const TriangleNodes side_on_axis = straight(0, 0, 0.8, 0.3, 0, 1);
const std::array<TriangleNodes, 3> elements{away, corner_on_axis, side_on_axis};

/// Twice the area over 2, times 2π times the radius of the centroid (Pappus).
double volume(const TriangleNodes& n) {
  const double area = 0.5 * ((n(1, 0) - n(0, 0)) * (n(2, 1) - n(0, 1)) - (n(2, 0) - n(0, 0)) * (n(1, 1) - n(0, 1)));
  return area * 2 * pi * (n(0, 0) + n(1, 0) + n(2, 0)) / 3;
}

TriangleVector field(const TriangleNodes& nodes, const std::function<std::array<double, 2>(double, double)>& u) {
  TriangleVector values;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const auto [r, z] = u(nodes(i, 0), nodes(i, 1));
    values(2 * i) = r;
    values(2 * i + 1) = z;
  }
  return values;
}

TEST_CASE("motion along the axis is the one rigid motion: it meets no force") {
  const TriangleVector shift = field(away, [](double, double) { return std::array{0.0, 1.0}; });
  const TriangleMatrix k = axisymmetric_triangle_stiffness(away, steel);
  CHECK((k * shift).norm() <= 1e-14 * k.norm());
  const Eigen::SelfAdjointEigenSolver<TriangleMatrix> modes(k);
  CHECK(std::abs(modes.eigenvalues()(0)) <= 1e-13 * modes.eigenvalues()(11));
  CHECK(modes.eigenvalues()(1) > 1e-4 * modes.eigenvalues()(11));
}

TEST_CASE("the energy of any homogeneous strain is exact, wherever the element lies") {
  const Eigen::Vector4d strain(0.3, 0.3, -0.7, 0.5);
  for (const AxisymmetricElasticity& material : {steel, fibres})
    for (const TriangleNodes& nodes : elements) {
      const TriangleVector u = field(nodes, [](double r, double z) { return std::array{0.3 * r, -0.7 * z + 0.5 * r}; });
      const double energy = 0.5 * u.dot(axisymmetric_triangle_stiffness(nodes, material) * u);
      CHECK(energy == about(0.5 * strain.dot(material.stiffness * strain) * volume(nodes)).epsilon(1e-13));
    }
}

TEST_CASE("the mass matrix integrates products of quadratic displacements exactly") {
  for (const TriangleNodes& nodes : elements) {
    const TriangleMatrix m = axisymmetric_triangle_consistent_mass(nodes, 7780);
    const TriangleVector ones = field(nodes, [](double, double) { return std::array{0.0, 1.0}; });
    CHECK(ones.dot(m * ones) == about(7780 * volume(nodes)).epsilon(1e-14));
    CHECK(m == m.transpose());
    CHECK(m(0, 1) == 0);
  }
  // ∫ r⁴ 2πr dA over the triangle (0,0) (1,0) (0,1): 2π ∫ r⁵ (1-r) dr = 2π/42.
  const TriangleNodes unit = straight(0, 0, 1, 0, 0, 1);
  const TriangleVector square = field(unit, [](double r, double) { return std::array{r * r, 0.0}; });
  CHECK(square.dot(axisymmetric_triangle_consistent_mass(unit, 1) * square) == about(2 * pi / 42).epsilon(1e-14));
}

TEST_CASE("the lumped mass is positive and adds up to the ring's mass in each direction") {
  for (const TriangleNodes& nodes : elements) {
    const TriangleVector m = axisymmetric_triangle_lumped_mass(nodes, 7780);
    CHECK(m.minCoeff() > 0);
    for (Eigen::Index direction = 0; direction < 2; ++direction) {
      double sum = 0;
      for (Eigen::Index i = 0; i < 6; ++i) sum += m(2 * i + direction);
      CHECK(sum == about(7780 * volume(nodes)).epsilon(1e-14));
    }
  }
}

/// ½ ∫ C_θθ u_r²/r 2π dA by bisecting the triangle many times, for u_r a quadratic given at the nodes.
double hoop_energy(const TriangleNodes& nodes, const std::function<double(double, double)>& u_r, int levels) {
  const double ra = nodes(0, 0), za = nodes(0, 1), rb = nodes(1, 0), zb = nodes(1, 1), rc = nodes(2, 0),
               zc = nodes(2, 1);
  if (levels > 0) {
    const TriangleNodes& n = nodes;
    double sum = 0;
    for (const auto& [i, j, k] : {std::array{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}})
      sum += hoop_energy(straight(n(i, 0), n(i, 1), n(j, 0), n(j, 1), n(k, 0), n(k, 1)), u_r, levels - 1);
    return sum;
  }
  const double r = (ra + rb + rc) / 3, z = (za + zb + zc) / 3;
  const double area = 0.5 * ((rb - ra) * (zc - za) - (rc - ra) * (zb - za));
  return pi * u_r(r, z) * u_r(r, z) / r * area;
}

TEST_CASE(
    "hoop terms: exact with a side on the axis, within 0.3 % at a corner on it, to 1e-4 (the oracle's own) away from "
    "it") {
  // A material that resists hoop strain only, so that K holds nothing but the 1/r terms.
  AxisymmetricElasticity hoop;
  hoop.stiffness.setZero();
  hoop.stiffness(1, 1) = 1;
  const auto compare = [&](const TriangleNodes& nodes, const std::function<double(double, double)>& u_r) {
    const TriangleVector u = field(nodes, [&](double r, double z) { return std::array{u_r(r, z), 0.0}; });
    const double energy = 0.5 * u.dot(axisymmetric_triangle_stiffness(nodes, hoop) * u);
    return energy / hoop_energy(nodes, u_r, 7) - 1;  // the midpoint sum: error 4^-7 of the variation, about 2e-5
  };
  const auto twisted = [](double r, double z) { return r * (1 - 1.3 * r + 0.6 * z); };
  CHECK(std::abs(compare(side_on_axis, twisted)) < 1e-4);
  CHECK(std::abs(compare(away, [](double r, double z) { return 1 - r + r * r + z; })) < 1e-4);
  // u_r that vanishes at the corner on the axis but not along it: the integrand then is singular in its derivatives.
  CHECK(std::abs(compare(corner_on_axis, [](double r, double z) { return z + r; })) < 3e-3);
}

TEST_CASE(
    "a uniform pressure on a disc: loads add up to it, none at the axis, and they do the work of a linear field") {
  const double a = 2.5;
  const Eigen::Vector3d load = axisymmetric_side_load(0, a);
  CHECK(load.sum() == about(pi * a * a).epsilon(1e-15));
  CHECK(load(0) == 0);
  const Eigen::Vector3d outer = axisymmetric_side_load(a, 3.1);
  CHECK(outer.sum() == about(pi * (3.1 * 3.1 - a * a)).epsilon(1e-14));
  // ∫ r 2πr dr
  CHECK(outer.dot(Eigen::Vector3d(a, 3.1, (a + 3.1) / 2)) ==
        about(2 * pi / 3 * (std::pow(3.1, 3) - std::pow(a, 3))).epsilon(1e-14));
}

TEST_CASE("tangled triangles are refused") {
  const TriangleNodes clockwise = straight(1, 0, 1.5, 1, 2, 0);
  CHECK_THROWS_WITH(axisymmetric_triangle_stiffness(clockwise, steel), doctest::Contains("turned inside out"));
  CHECK_THROWS_WITH(axisymmetric_triangle_consistent_mass(straight(-1, 0, 0.5, 0, 0, 1), 1),
                    doctest::Contains("reaches across the axis"));
}

}  // namespace
}  // namespace impulse
