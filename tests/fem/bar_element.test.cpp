#include "fem/elements/bar_element.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace impulse {
namespace {

const Segment cone{0.4, 0.030, 0.075, {"nylon", 2.8e9, 1150, {}}};
const Segment cylinder{0.5, 0.010, 0.010, {"steel", 206e9, 7780, {}}};

/// Shape function of a node whose ψ = x·u is linear; x from the apex, s along the element.
double shape(const Segment& element, int node, double s) {
  const double d = element.diameter_a_m + (element.diameter_b_m - element.diameter_a_m) * s;
  return node == 0 ? element.diameter_a_m * (1 - s) / d : element.diameter_b_m * s / d;
}

double area(const Segment& element, double s) {
  const double d = element.diameter_a_m + (element.diameter_b_m - element.diameter_a_m) * s;
  return std::numbers::pi / 4 * d * d;
}

TEST_CASE("the stiffness of a cone element is the exact static one: the integral of ds/(EA) inverted") {
  // Simpson's rule with 2000 intervals, error below 1e-12 here.
  const int n = 2000;
  double flexibility = 0;
  for (int i = 0; i <= n; ++i) {
    const double weight = (i == 0 || i == n) ? 1 : (i % 2 == 1 ? 4 : 2);
    flexibility += weight * cone.length_m / (3.0 * n) / (cone.material.youngs_modulus_Pa * area(cone, i / double(n)));
  }
  const Eigen::Matrix2d k = bar_element_stiffness(cone);
  CHECK(k(0, 0) * flexibility == about(1).epsilon(1e-11));
  CHECK(k(0, 1) == -k(0, 0));
  CHECK(k(1, 0) == k(0, 1));
  CHECK(k(1, 1) == k(0, 0));
}

TEST_CASE("two cone elements in series are one: the interpolation contains the static solution") {
  Segment front = cone;
  front.length_m = 0.25 * cone.length_m;
  front.diameter_b_m = 0.030 + 0.25 * 0.045;
  Segment back = cone;
  back.length_m = 0.75 * cone.length_m;
  back.diameter_a_m = front.diameter_b_m;
  const double series = 1 / bar_element_stiffness(front)(0, 0) + 1 / bar_element_stiffness(back)(0, 0);
  CHECK(series * bar_element_stiffness(cone)(0, 0) == about(1).epsilon(1e-15));
}

TEST_CASE("the consistent mass is the integral of the interpolation") {
  // ρA NᵢNⱼ is a polynomial of degree 2: Simpson's rule is exact.
  const Eigen::Matrix2d mass = bar_element_consistent_mass(cone);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      double integral = 0;
      for (const auto& [s, weight] : {std::pair{0.0, 1.0}, {0.5, 4.0}, {1.0, 1.0}})
        integral += weight / 6 * cone.length_m * 1150 * area(cone, s) * shape(cone, i, s) * shape(cone, j, s);
      CHECK(mass(i, j) == about(integral).epsilon(1e-14));
    }
}

TEST_CASE("both mass matrices weigh what the frustum weighs, and the lumped one is the row sum") {
  for (const Segment& element : {cone, cylinder}) {
    CHECK(bar_element_consistent_mass(element).sum() == about(element.mass_kg()).epsilon(1e-15));
    CHECK(bar_element_lumped_mass(element).sum() == about(element.mass_kg()).epsilon(1e-15));
    const Eigen::Vector2d rows = bar_element_consistent_mass(element).rowwise().sum();
    CHECK((bar_element_lumped_mass(element) - rows).norm() <= 1e-15 * rows.norm());
  }
}

TEST_CASE("a rigid translation bears no force, and the reversed element is the mirror image") {
  const Segment mirror{cone.length_m, cone.diameter_b_m, cone.diameter_a_m, cone.material};
  CHECK((bar_element_stiffness(cone) * Eigen::Vector2d::Ones()).norm() == 0);
  CHECK((bar_element_stiffness(mirror) - bar_element_stiffness(cone).reverse()).norm() == 0);
  CHECK((bar_element_consistent_mass(mirror) - bar_element_consistent_mass(cone).reverse()).norm() == 0);
}

TEST_CASE("the fastest frequency of an element is 2c/h for a cylinder and grows with the square of the taper") {
  const double limit = 2 * std::sqrt(206e9 / 7780.0) / 0.5;
  CHECK(bar_element_highest_frequency(cylinder) == about(limit).epsilon(1e-15));
  for (const double taper : {0.1, 0.05, 0.025}) {
    Segment element = cylinder;
    element.diameter_b_m = (1 + taper) * element.diameter_a_m;
    const double excess = std::pow(bar_element_highest_frequency(element) / limit, 2) - 1;
    CHECK(excess / (taper * taper) == about(1.0 / 9).epsilon(1.5 * taper));
  }
}

}  // namespace
}  // namespace impulse
