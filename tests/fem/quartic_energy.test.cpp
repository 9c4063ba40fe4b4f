#include "fem/reduced_basis/quartic_energy.hpp"

#include "fem/reduced_basis/reduced_equations.hpp"
#include "fem/reduced_basis/wide_product.hpp"
#include "lib/numerics/quadrature.hpp"
#include "tests/support/about.hpp"
#include "tests/support/shells.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>

namespace impulse {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
constexpr double pi = std::numbers::pi;

Shell curved_panel() {
  PanelShape shape{.length_m = 0.15, .width_m = 0.10, .curvature = Curvature::along_y, .radius_m = 0.4};
  const Laminate plies = laminate(layers_of("[0/45/0/-45]", parse_ply("graphite-epoxy"), 1e-3));
  return Shell(shells::panel(shape, plies, "ICTI", 3, 3));
}

struct Case {
  Shell shell = curved_panel();
  Structure body = shell_structure(shell, {{0.07, 0.06}});
  ReducedBasis modes = modal_basis(shell, body, 7, ModeKind::any);
  QuarticReduction reduction = quartic_reduction([this](const VectorXd& q) { return shell.internal(q).force; },
                                                 body.stiffness, modes.vectors, amplitudes());

  [[nodiscard]] VectorXd amplitudes() const {
    return 1e-3 * modes.vectors.cwiseAbs().colwise().maxCoeff().cwiseInverse().transpose() * 100;
  }
  [[nodiscard]] VectorXd coordinates() const {
    VectorXd z(7);
    z << 1, -0.7, 0.4, 0.9, -0.3, 0.2, -0.8;
    return 8 * z.cwiseProduct(amplitudes());
  }
};

TEST_CASE("tensors give the energy and the force of the whole mesh, to rounding") {
  const Case c;
  const VectorXd z = c.coordinates();
  const ShellForce whole = c.shell.internal(c.modes.vectors * z);
  const VectorXd expected = c.modes.vectors.transpose() * whole.force;
  const VectorXd found = c.reduction.energy.force(z, pair_products(z));
  CHECK((found - expected).norm() <= 1e-10 * expected.norm());
  CHECK(c.reduction.energy.energy(z) == about(whole.energy_J).epsilon(1e-10));
  // The orders matter here: neither of the higher ones is small.
  const VectorXd linear = c.modes.stiffness * z;
  CHECK((expected - linear).norm() > 0.2 * expected.norm());
}

TEST_CASE("the quadratic force outside the basis is the even part of the whole force") {
  const Case c;
  const VectorXd z = c.coordinates(), q = c.modes.vectors * z;
  const VectorXd even = (c.shell.internal(q).force + c.shell.internal(-q).force) / 2;
  CHECK((c.reduction.quadratic_force * pair_products(z) - even).norm() <= 1e-10 * even.norm());
}

TEST_CASE("condensation is the minimum over coordinates that enter quadratically") {
  // E(z, y) = quartic(z) + pᵀFᵀy + ½yᵀHy; least over y at y = -H⁻¹Fp.
  QuarticEnergy energy{MatrixXd::Identity(3, 3), MatrixXd::Zero(3, 6), MatrixXd::Zero(3, 10)};
  MatrixXd f(2, 6), h(2, 2);
  f << 1, -2, 0.5, 3, 0.2, -1, 0.3, 1, -1, 0.7, 2, 0.1;
  h << 3, 1, 1, 2;
  const MatrixXd g = f.transpose() * h.inverse() * f;
  condense(energy, g);
  VectorXd z(3);
  z << 0.3, -0.7, 1.1;
  const VectorXd p = pair_products(z), y = -h.inverse() * f * p;
  const auto whole = [&](const VectorXd& at, const VectorXd& own) {
    return at.squaredNorm() / 2 + own.dot(f * pair_products(at)) + own.dot(h * own) / 2;
  };
  CHECK(energy.energy(z) == about(whole(z, y)).epsilon(1e-13));
  const VectorXd force = energy.force(z, p);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const VectorXd d = 1e-3 * VectorXd::Unit(3, i);
    // At the minimum the force is the derivative with y held; a cubic difference is exact but for its fourth order.
    CHECK(force(i) == about((whole(z + d, y) - whole(z - d, y)) / 2e-3).epsilon(1e-12));
  }
}

/// Ratio of the frequency at an amplitude A to the linear one, for z̈ + ω²(z + βz³) = 0: with z = A sin θ energy is
/// ż² = ω²A² cos²θ (1 + βA²(1 + sin²θ)/2).
double duffing_ratio(double beta_amplitude_squared) {
  const QuadratureRule rule = gauss_legendre(20);
  double quarter = 0;
  for (Eigen::Index i = 0; i < rule.points.size(); ++i) {
    const double s = std::sin(pi / 4 * (1 + rule.points(i)));
    quarter += pi / 4 * rule.weights(i) / std::sqrt(1 + beta_amplitude_squared * (1 + s * s) / 2);
  }
  return pi / 2 / quarter;
}

TEST_CASE("a plate in one shape, its plane condensed, hardens as by von Kármán: frequency against amplitude") {
  constexpr double h = 1e-3;
  const PanelShape square{.length_m = 1, .width_m = 1};
  const auto beta = [&](const std::string& edges, bool squared) {
    const Shell shell(shells::panel(square, shells::isotropic(1e9, 0.3, h, 1), edges, 12, 12));
    const Structure body = shell_structure(shell, {{0.5, 0.5}});
    ReducedBasis shape = modal_basis(shell, body, 1, ModeKind::any);
    if (squared) {  // sin² sin², which is not a mode
      PanelShape pressed = square;
      pressed.imperfection.squared_waves = {{1, 1, 1}};
      VectorXd values = VectorXd::Zero(shell.nodal_values(shells::rest(shell)).size());
      for (std::size_t k = 0; k < 169; ++k)
        values.segment<4>(static_cast<Eigen::Index>(12 * k + 8)) =
            mid_surface(pressed, static_cast<double>(k % 13) / 12, static_cast<double>(k / 13) / 12).row(2).transpose();
      shape.vectors = shell.restrained(values);
      shape.vectors /= std::sqrt(shape.vectors.col(0).dot(body.mass * shape.vectors.col(0)));
      shape.stiffness = shape.vectors.transpose() * body.stiffness * shape.vectors;
    }
    const TensorModel model = tensor_model(shell, body, *SparseCholesky::of(body.stiffness), shape, 1);
    const double height = body.contacts.col(0).dot(shape.vectors.col(0));
    return model.energy.cubic(0, 0) / model.energy.stiffness(0, 0) * h * h / (height * height);
  };
  const double simple = beta("IIII", false), clamped = beta("CCCC", true);
  CHECK(simple == about(1.3229).epsilon(0.001));
  CHECK(clamped == about(.5109).epsilon(0.001));
  const double simple_ratio[5] = {1.0196, 1.0760, 1.1633, 1.2746, 1.4041};
  const double clamped_ratio[5] = {1.0076, 1.0301, 1.0664, 1.1150, 1.1742};
  for (int i = 0; i < 5; ++i) {
    const double amplitude = 0.2 * (i + 1);  // per thickness
    CHECK(duffing_ratio(simple * amplitude * amplitude) == about(simple_ratio[i]).epsilon(1e-3));
    CHECK(duffing_ratio(clamped * amplitude * amplitude) == about(clamped_ratio[i]).epsilon(1e-3));
  }
}

TEST_CASE("the tangent is the derivative of the force") {
  const Case c;
  const VectorXd z = c.coordinates();
  const MatrixXd tangent = c.reduction.energy.tangent(z);
  CHECK((tangent - tangent.transpose()).norm() <= 1e-12 * tangent.norm());
  for (Eigen::Index i = 0; i < 7; ++i) {
    const VectorXd d = z(i) * VectorXd::Unit(7, i);
    const auto slope = [&](double scale) -> VectorXd {
      const VectorXd up = z + scale * d, down = z - scale * d;
      return (c.reduction.energy.force(up, pair_products(up)) - c.reduction.energy.force(down, pair_products(down))) /
             (2 * scale * z(i));
    };
    // Of a cubic, central differences at h and 2h extrapolate to the derivative exactly.
    const VectorXd exact = (4 * slope(0.1) - slope(0.2)) / 3;
    CHECK((tangent.col(i) - exact).norm() <= 1e-11 * tangent.norm());
  }
}

TEST_CASE("in the span of the finite vectors the model is the mesh, and the other vectors keep their stiffness") {
  const Case c;
  const ReducedBasis given = ritz_basis(c.body.stiffness, c.body.mass, c.body.contacts.col(0), 12);
  const TensorModel model = tensor_model(c.shell, c.body, *SparseCholesky::of(c.body.stiffness), given, 5);
  // The finite vectors as given, the others turned among themselves: K of the basis is the basis' and diagonal in them.
  const ReducedBasis& ritz = model.basis;
  CHECK(ritz.vectors.leftCols(5) == given.vectors.leftCols(5));
  const MatrixXd turn = given.vectors.transpose() * c.body.mass * ritz.vectors;
  CHECK((turn * turn.transpose() - MatrixXd::Identity(12, 12)).norm() <= 1e-12);
  CHECK((ritz.vectors - given.vectors * turn).norm() <= 1e-12 * given.vectors.norm());
  CHECK((ritz.stiffness - turn.transpose() * given.stiffness * turn).norm() <= 1e-12 * given.stiffness.norm());
  CHECK(MatrixXd(ritz.stiffness.bottomRightCorner(7, 7)).isDiagonal(0));
  const auto equations = tensor_equations(model);
  // Small: the nonlinear terms are gone, and force and energy are those of the linear mesh in the basis.
  const VectorXd small = 1e-9 * VectorXd::LinSpaced(12, -1, 2);
  const VectorXd linear = ritz.stiffness * small;
  CHECK((equations->internal_force(small) - linear).norm() <= 1e-5 * linear.norm());
  CHECK(equations->elastic_energy(small) / (small.dot(linear) / 2) == about(1).epsilon(1e-5));
  // Finite: what the static coordinates take is the energy of the mesh's quadratic force on what the basis leaves out.
  VectorXd q = VectorXd::Zero(12);
  q.head(5) << 2e-3, -1e-3, 5e-4, 1e-3, -7e-4;
  q.tail(7).setLinSpaced(-1e-5, 3e-5);
  const VectorXd z = ritz.vectors.leftCols(5) * q.head(5), y = ritz.vectors.rightCols(7) * q.tail(7);
  const VectorXd even = (c.shell.internal(z).force + c.shell.internal(-z).force) / 2;
  const MatrixXd basis = ritz.vectors;
  const VectorXd slaved =
      basis * ritz.stiffness.ldlt().solve(basis.transpose() * even) - SparseCholesky::of(c.body.stiffness)->solve(even);
  const double expected =
      c.shell.internal(z).energy_J + y.dot(c.body.stiffness * (z + y / 2)) + y.dot(even) + even.dot(slaved) / 2;
  CHECK(equations->elastic_energy(q) / expected == about(1).epsilon(1e-9));
  CHECK((expanded(model, q) - (z + y + slaved)).norm() <= 1e-9 * z.norm());
  CHECK(even.dot(slaved) < -1e-3 * expected);  // it matters here
  // The force is the energy's derivative, and the tangent's matrix the force's.
  const VectorXd force = equations->internal_force(q);
  for (Eigen::Index i : {0, 3, 5, 11}) {
    const double h = 1e-3 * std::abs(q(i));
    const VectorXd d = h * VectorXd::Unit(12, i);
    const double slope = (equations->elastic_energy(q + d) - equations->elastic_energy(q - d)) / (2 * h);
    CHECK(slope / force(i) == about(1).epsilon(1e-4));
    const VectorXd column = (equations->internal_force(q + d) - equations->internal_force(q - d)) / (2 * h);
    const VectorXd back = equations->tangent_solver(0, 1, q)(column);
    CHECK((back - VectorXd::Unit(12, i)).norm() <= 1e-4);
  }
}

TEST_CASE("the product by wide registers is the product") {
  for (const Eigen::Index rows : {1, 7, 8, 12, 20})
    for (const Eigen::Index columns : {1, 6, 35}) {
      const MatrixXd a = MatrixXd::Random(rows, columns);
      const VectorXd x = VectorXd::Random(columns);
      VectorXd y = VectorXd::Ones(rows);
      add_product(a, x, y);
      CHECK((y - VectorXd::Ones(rows) - a * x).norm() <= 1e-14 * static_cast<double>(columns));
    }
}

TEST_CASE("tensors of too many vectors are refused") {
  const Case c;
  CHECK_THROWS_WITH_AS((void)quartic_reduction([](const VectorXd& q) { return q; }, c.body.stiffness,
                                               MatrixXd::Zero(c.shell.size(), 41), VectorXd::Ones(41)),
                       "tensors of 41 vectors (1 to 40) are dearer than evaluating the mesh", std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)tensor_model(c.shell, c.body, *SparseCholesky::of(c.body.stiffness), c.modes, 8),
                       "8 nonlinear vectors of 7; ask for no more than there are", std::invalid_argument);
}

}  // namespace
}  // namespace impulse
