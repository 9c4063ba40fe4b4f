#include "lib/numerics/quadrature.hpp"

#include "lib/contract/require.hpp"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_legendre.h>

#include <memory>
#include <new>
#include <vector>

namespace impulse {
namespace {

/// GSL's rules are exact to rounding at some counts only, else to 1e-10: Newton's method on Pₙ(x) = 0, and
/// w = 2/((1 - x²) Pₙ'²).
void polish(std::size_t count, double& x, double& w) {
  std::vector<double> value(count + 1), slope(count + 1);
  for (int step = 0; step < 2; ++step) {
    gsl_sf_legendre_Pl_deriv_array(static_cast<int>(count), x, value.data(), slope.data());
    x -= value[count] / slope[count];
  }
  gsl_sf_legendre_Pl_deriv_array(static_cast<int>(count), x, value.data(), slope.data());
  w = 2 / ((1 - x * x) * slope[count] * slope[count]);
}

}  // namespace

QuadratureRule gauss_legendre(std::size_t count) {
  require(count > 0, "a quadrature rule has at least one point");
  using Table = std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)>;
  const Table table(gsl_integration_glfixed_table_alloc(count), gsl_integration_glfixed_table_free);
  if (!table) throw std::bad_alloc();
  const auto n = static_cast<Eigen::Index>(count);
  QuadratureRule rule{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i)
    gsl_integration_glfixed_point(-1, 1, static_cast<std::size_t>(i), &rule.points(i), &rule.weights(i), table.get());
  for (Eigen::Index i = 0; i < n; ++i) polish(count, rule.points(i), rule.weights(i));
  return rule;
}

}  // namespace impulse
