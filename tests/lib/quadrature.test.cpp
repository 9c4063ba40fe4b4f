#include "lib/numerics/quadrature.hpp"

#include <doctest/doctest.h>

#include <cmath>

TEST_CASE("Gauss-Legendre rules are exact for Legendre polynomials up to degree 2n - 1") {
  for (std::size_t count = 1; count <= 100; ++count) {
    const impulse::QuadratureRule rule = impulse::gauss_legendre(count);
    double worst = std::abs(rule.weights.sum() - 2);
    Eigen::VectorXd before = Eigen::VectorXd::Ones(rule.points.size()), now = rule.points;
    for (std::size_t degree = 1; degree < 2 * count; ++degree) {
      worst = std::max(worst, std::abs(rule.weights.dot(now)));
      const auto d = static_cast<double>(degree);
      const Eigen::VectorXd next = ((2 * d + 1) * rule.points.cwiseProduct(now) - d * before) / (d + 1);
      before = now;
      now = next;
    }
    CAPTURE(count);
    CHECK(worst < 1e-14);  // a few ε of the weights' sum
  }
  CHECK_THROWS_WITH((void)impulse::gauss_legendre(0), "a quadrature rule has at least one point");
}
