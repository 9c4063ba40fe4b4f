#include "fem/bodies/bar_structure.hpp"

#include "fem/explicit/central_difference.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bars.hpp"

#include <doctest/doctest.h>

#include <Eigen/SparseLU>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace impulse {
namespace {

Bar chain(std::vector<Face> faces = {Face::a}, FarEnd far_end = FarEnd::free) {
  return {
      {parse_segment("125mm,32mm,nylon-6"), parse_segment("400mm,30mm,75mm,nylon-6"), parse_segment("0.2m,10mm,steel")},
      std::move(faces),
      far_end};
}

Eigen::VectorXd solve(const Eigen::SparseMatrix<double>& matrix, const Eigen::VectorXd& load) {
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> factorisation(matrix);
  return factorisation.solve(load);
}

TEST_CASE("a bar weighs what its profile weighs, with both mass matrices, and floats without strain") {
  for (const MassMatrix mass : {MassMatrix::lumped, MassMatrix::consistent}) {
    const Bar bar = chain();
    const Structure body = bar_structure(bar, bar_mesh_by_count(bar, 40, mass));
    CHECK(body.stiffness.rows() == 41);
    CHECK(body.mass.sum() == about(mass_kg(bar.profile)).epsilon(1e-14));
    CHECK((body.stiffness * Eigen::VectorXd::Ones(41)).norm() <= 1e-14 * body.stiffness.norm());
    CHECK(body.mass.nonZeros() == (mass == MassMatrix::lumped ? 41 : 3 * 41 - 2));
    CHECK(body.dashpots.size() == 0);
  }
}

TEST_CASE("contacts follow the order of the faces and point into the body") {
  const Bar bar = chain({Face::b, Face::a});
  const Structure body = bar_structure(bar, bar_mesh_by_count(bar, 20));
  REQUIRE(body.contacts.cols() == 2);
  CHECK(body.contacts(20, 0) == -1);
  CHECK(body.contacts(0, 1) == 1);
  CHECK(body.contacts.cwiseAbs().sum() == 2);
  CHECK(body.wave_admittance(0, 0) == about(1 / face_impedance_kg_per_s(bar.profile, Face::b)));
  CHECK(body.wave_admittance(1, 1) == about(1 / face_impedance_kg_per_s(bar.profile, Face::a)));
  CHECK(body.wave_admittance(0, 1) == 0);
}

TEST_CASE("a reversed bar struck on the other face is the same body, and A answers B as B answers A") {
  const Bar bar = chain({Face::a, Face::b});
  const Bar mirror{reversed(bar.profile), {Face::b, Face::a}, FarEnd::free};
  const Structure one = bar_structure(bar, bar_mesh_by_count(bar, 30));
  const Structure two = bar_structure(mirror, bar_mesh_by_count(mirror, 30));
  // Receptance at a frequency between the modes: (K - ω²M)⁻¹ as the faces see it.
  const double omega = 2e4;
  const Eigen::SparseMatrix<double> k_one = one.stiffness - omega * omega * one.mass;
  const Eigen::SparseMatrix<double> k_two = two.stiffness - omega * omega * two.mass;
  Eigen::Matrix2d seen_one, seen_two;
  for (Eigen::Index j = 0; j < 2; ++j) {
    seen_one.col(j) = one.contacts.transpose() * solve(k_one, one.contacts.col(j));
    seen_two.col(j) = two.contacts.transpose() * solve(k_two, two.contacts.col(j));
  }
  CHECK((seen_one - seen_two).norm() <= 1e-10 * seen_one.norm());
  CHECK(std::abs(seen_one(0, 1) - seen_one(1, 0)) <= 1e-10 * seen_one.norm());
}

TEST_CASE("a fixed far end is eliminated, and the cone then yields exactly as its static solution at every node") {
  const double slope = 0.045 / 0.4;
  for (const Face face : {Face::a, Face::b}) {
    const Bar bar{bars::cone().profile, {face}, FarEnd::fixed};
    const Structure body = bar_structure(bar, bar_mesh_by_count(bar, 8));
    REQUIRE(body.stiffness.rows() == 8);
    const Eigen::VectorXd u = solve(body.stiffness, body.contacts.col(0));
    for (Eigen::Index i = 0; i < 8; ++i) {
      // u(x) = ∫ dx/(EA) from x to the fixed end = 4|1/D(x) - 1/D_fixed| / (πE slope)
      const double x = 0.4 / 8 * static_cast<double>(face == Face::a ? i : i + 1);
      const double fixed_diameter = face == Face::a ? 0.075 : 0.030;
      const double exact =
          4 / (std::numbers::pi * 2.8e9 * slope) * std::abs(1 / (0.030 + slope * x) - 1 / fixed_diameter);
      CHECK((face == Face::a ? u[i] : -u[i]) == about(exact).epsilon(1e-13));
    }
  }
}

TEST_CASE("an infinite far end is a dashpot of the section's impedance opposite the face") {
  const Bar a = chain({Face::a}, FarEnd::infinite);
  const Structure from_a = bar_structure(a, bar_mesh_by_count(a, 10));
  REQUIRE(from_a.dashpots.size() == 11);
  CHECK(from_a.dashpots[10] == about(face_impedance_kg_per_s(a.profile, Face::b)));
  CHECK(from_a.dashpots.sum() == from_a.dashpots[10]);
  const Bar b = chain({Face::b}, FarEnd::infinite);
  CHECK(bar_structure(b, bar_mesh_by_count(b, 10)).dashpots[0] == about(face_impedance_kg_per_s(b.profile, Face::a)));
}

TEST_CASE("a mesh by count shares the elements out by travel time, each segment at least one") {
  const Bar bar = bars::composite();  // nylon 80.1 us, aluminium 24.7 us
  CHECK(bar_mesh_by_count(bar, 4).elements == std::vector<std::size_t>{1, 1, 1, 1});
  CHECK(bar_mesh_by_count(bar, 8).elements == std::vector<std::size_t>{3, 1, 3, 1});
  CHECK(bar_mesh_by_count(bar, 210).elements == std::vector<std::size_t>{80, 25, 80, 25});
}

TEST_CASE("a mesh by step has elements of at least the step's travel time, and no fewer than possible") {
  const Bar bar = bars::composite();
  CHECK(bar_mesh_by_step(bar, 5e-6).elements == std::vector<std::size_t>{16, 4, 16, 4});
  const Bar rod = bars::long_rod();
  for (const std::size_t n : {7u, 30u, 997u}) {
    const double step = travel_time_s(rod.profile) / static_cast<double>(n);
    CHECK(bar_mesh_by_step(rod, step).elements.front() == n);
    CHECK(bar_mesh_by_step(rod, step * (1 + 1e-9)).elements.front() == n - 1);
  }
}

TEST_CASE("what a mesh by step gives is stable at that step, tapered segments included") {
  for (const double step_us : {0.7, 3.0, 11.0, 24.0})
    for (const FarEnd far_end : {FarEnd::free, FarEnd::fixed}) {
      for (const Bar& bar :
           {Bar{bars::cone().profile, {Face::a}, far_end}, Bar{bars::composite().profile, {Face::b}, far_end}}) {
        const Structure body = bar_structure(bar, bar_mesh_by_step(bar, step_us * 1e-6));
        CHECK(stability_limit_s(body) >= step_us * 1e-6 * (1 - 2e-12));
      }
    }
  // At exactly τ/n the mode at the small end is a little too fast for n elements.
  const Bar cone = bars::cone();
  const double step = travel_time_s(cone.profile) / 20;
  CHECK(bar_mesh_by_step(cone, step).elements.front() == 19);
  CHECK(stability_limit_s(bar_structure(cone, bar_mesh_by_count(cone, 20))) < step);
}

TEST_CASE("meshes that cannot be are refused") {
  const Bar bar = bars::composite();
  CHECK_THROWS_WITH_AS((void)bar_mesh_by_count(bar, 100'000'000'000),
                       doctest::Contains("more than a bar takes (1e+06)"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)bar_mesh_by_count(bar, 3), "3 elements do not mesh 4 segments (each needs one)",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)bar_mesh_by_step(bar, 30e-6),
                       "step 30 us is too long for segment 2 (one element of it is stable up to 24.73 us); use a step "
                       "of 24.72 us or less",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)bar_mesh_by_step(bar, 0), "step 0 s is not positive", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)bar_mesh_by_step(bar, 1e-15),
                       "step 1e-15 s makes 8.01e+10 elements in segment 1 (more than 1e+06); use a longer step",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)bar_structure(bar, {{1, 2}}), "a mesh of 2 segments for a bar of 4",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)bar_structure(bar, {{1, 0, 1, 1}}), "segment 2 has no element", std::invalid_argument);
  CHECK_THROWS_AS((void)bar_structure(Bar{}, {{}}), std::invalid_argument);
}

}  // namespace
}  // namespace impulse
