#include "fem/bodies/axisymmetric_solid.hpp"
#include "fem/implicit/step_response.hpp"
#include "fem/mesh/solid_mesh.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace impulse {
namespace {

constexpr double pi = std::numbers::pi;
const Material nylon = parse_material("nylon-6:0.40");

/// Displacement of a half-space under a unit force on a circle of radius a: under a rigid flat [Boussinesq], and the
/// mean under a uniform pressure.
double half_space_flexibility(CircleContact contact, double a) {
  const double rate = (1 - std::pow(*nylon.poissons_ratio, 2)) / (nylon.youngs_modulus_Pa * a);
  return contact == CircleContact::punch ? rate / 2 : 16 * rate / (3 * pi * pi);
}

SolidStructure graded(const Profile& profile, Face face, double a, CircleContact contact, double size_per_radius,
                      EndSupport far) {
  AxisymmetricSolid solid{.mesh = solid_mesh(profile, {{face, a, size_per_radius * a}}),
                          .materials = {isotropic_elasticity(profile[0].material)},
                          .contacts = {{face, a, contact}}};
  (face == Face::a ? solid.end_b : solid.end_a) = far;
  return axisymmetric_structure(solid);
}

double static_flexibility(const Structure& body) {
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor(body.stiffness);
  return body.contacts.col(0).dot(Eigen::VectorXd(factor.solve(body.contacts.col(0))));
}

TEST_CASE("a circle on a cylinder of 400 of its radii is as flexible as on a half-space, within 0.5 %") {
  // What is left: 0.09 h/a at the punch's singular edge (0.2 % for a/40), and the cylinder's size, of order a/b = 0.25
  // % and of the other sign.
  const double a = 1e-3;
  const Profile cylinder{{400 * a, 800 * a, 800 * a, nylon}};
  for (const CircleContact contact : {CircleContact::punch, CircleContact::pressure}) {
    const Structure body = graded(cylinder, Face::a, a, contact, 1.0 / 40, EndSupport::fixed).structure;
    CHECK(static_flexibility(body) == about(half_space_flexibility(contact, a)).epsilon(0.005));
  }
}

TEST_CASE("the punch is too stiff by about 0.09 h/a, the pressure wrong by less than 0.02 h/a") {
  const double a = 1e-3;
  const Profile cylinder{{20 * a, 40 * a, 40 * a, nylon}};
  std::vector<double> punch, pressure;
  for (const double h : {0.5, 0.25, 0.125, 0.0625, 0.015625}) {
    punch.push_back(
        static_flexibility(graded(cylinder, Face::a, a, CircleContact::punch, h, EndSupport::fixed).structure));
    pressure.push_back(
        static_flexibility(graded(cylinder, Face::a, a, CircleContact::pressure, h, EndSupport::fixed).structure));
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const double h = std::pow(0.5, 1.0 + double(i));
    const double missing = 1 - punch[i] / punch[4];
    CHECK(missing > 0.05 * (h - 0.0156));
    CHECK(missing < 0.13 * (h - 0.0156));
    CHECK(std::abs(pressure[i] / pressure[4] - 1) < 0.02 * h);
  }
}

TEST_CASE("20 us after a unit step force the circle on the cone's large face sits on the half-space's displacement") {
  // The first echo, from the edge of the face, is back after about 30 us.
  const Profile cone{parse_segment("400mm,30mm,75mm,nylon-6:0.40")};
  const UniformGrid grid = grid_over(20e-6, 1e-6);
  for (const CircleContact contact : {CircleContact::punch, CircleContact::pressure}) {
    const Structure body = graded(cone, Face::b, 5e-3, contact, 0.05, EndSupport::free).structure;
    const auto u = step_displacements(body, grid, {.substeps = 4, .observer = {}});
    CHECK(u[0].back() == about(half_space_flexibility(contact, 5e-3)).epsilon(0.005));
    // A plane dilatational wave at first: U = t/(ρ c_L π a²), before the edge is heard at the middle (2.2 us).
    CHECK(u[0][1] < 1e-6 * body.wave_admittance(0, 0));
    CHECK(u[0][1] > 0.8e-6 * body.wave_admittance(0, 0));
  }
}

}  // namespace
}  // namespace impulse
