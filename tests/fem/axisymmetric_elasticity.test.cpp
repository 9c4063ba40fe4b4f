#include "fem/elements/axisymmetric_elasticity.hpp"
#include "tests/support/about.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace impulse {
namespace {

const Material nylon{"nylon", 2.8e9, 1150, 0.4};

TEST_CASE("isotropic elasticity has Lamé's constants") {
  const Eigen::Matrix4d c = isotropic_elasticity(nylon).stiffness;
  const double lambda = 2.8e9 * 0.4 / (1.4 * 0.2), mu = 2.8e9 / 2.8;
  Eigen::Matrix4d expected = Eigen::Matrix4d::Zero();
  expected.topLeftCorner<3, 3>().setConstant(lambda);
  expected.diagonal() += Eigen::Vector4d(2 * mu, 2 * mu, 2 * mu, mu);
  CHECK((c - expected).norm() <= 1e-15 * 20 * expected.norm());  // a dozen roundings, divided by 1 - 2ν = 0.2
}

TEST_CASE("the dilatational wave speed is that of the constants") {
  // c_L² = E (1-ν)/(ρ (1+ν)(1-2ν)): 2284.2 m/s for this nylon.
  CHECK(isotropic_elasticity(nylon).axial_wave_speed_m_per_s() ==
        about(std::sqrt(2.8e9 * 0.6 / (1150 * 1.4 * 0.2))).epsilon(1e-14));
}

TEST_CASE("transversely isotropic elasticity inverts the compliance of its engineering constants") {
  const double ea = 120e9, et = 7.9e9, va = 0.3, vt = 0.45, g = 5.5e9;
  Eigen::Matrix4d compliance = Eigen::Matrix4d::Zero();
  compliance.topLeftCorner<3, 3>() << 1 / et, -vt / et, -va / ea, -vt / et, 1 / et, -va / ea, -va / ea, -va / ea,
      1 / ea;
  compliance(3, 3) = 1 / g;
  const Eigen::Matrix4d c = transversely_isotropic_elasticity({ea, et, va, vt, g, 1580}).stiffness;
  CHECK((c * compliance - Eigen::Matrix4d::Identity()).norm() <= 1e-13);  // ε times the ratio of the moduli
  CHECK(c == c.transpose());
}

TEST_CASE("materials without positive strain energy are refused") {
  CHECK_THROWS_WITH(isotropic_elasticity({"nylon-6", 2.8e9, 1150, std::nullopt}),
                    "material 'nylon-6' has no Poisson's ratio, which a solid needs; add it, as in nylon-6:0.3");
  CHECK_THROWS_WITH(isotropic_elasticity({"rubber", 1e6, 1000, 0.5}),
                    "Poisson's ratio 0.5 of 'rubber' is outside (-1, 0.5)");
  CHECK_THROWS_WITH(transversely_isotropic_elasticity({0, 1, 0, 0, 1, 1}),
                    "axial modulus 0 is not positive and finite");
  CHECK_THROWS_WITH(transversely_isotropic_elasticity({1, 1, 0, 0, 1, -1}), "density -1 is not positive and finite");
  CHECK_THROWS_WITH(transversely_isotropic_elasticity({1, 4, 0.3, 0.3, 1, 1}),
                    doctest::Contains("make a material that releases energy when strained"));
}

}  // namespace
}  // namespace impulse
