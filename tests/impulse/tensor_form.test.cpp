#include "impulse/bodies/tensor_form.hpp"

#include "lib/numerics/quadrature.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace impulse;

namespace {

const PlateShape trapezoid{{{{0.1, -0.5}, {1, -0.25}, {1.3, 0.4}, {0, 0.5}}}};

/// The form point by point, every function's strains from field_functional.
Eigen::MatrixXd by_points(const std::vector<FormField>& fields, const Eigen::MatrixXd& weight, const PlateShape& shape,
                          std::size_t points) {
  const QuadratureRule rule = gauss_legendre(points);
  Eigen::MatrixXd sum;
  for (Eigen::Index p = 0; p < rule.points.size(); ++p)
    for (Eigen::Index q = 0; q < rule.points.size(); ++q) {
      const Eigen::Vector2d at(rule.points(p), rule.points(q));
      std::vector<Eigen::MatrixXd> parts;
      Eigen::Index size = 0;
      for (const FormField& field : fields) {
        Eigen::MatrixXd part(weight.rows(), field.basis->size() * field.basis->size());
        for (Eigen::Index i = 0; i < part.rows(); ++i)
          part.row(i) = field_functional(*field.basis, shape, at, field.operators.row(i)).transpose();
        parts.push_back(part);
        size += part.cols();
      }
      Eigen::MatrixXd strains(weight.rows(), size);
      Eigen::Index begin = 0;
      for (const Eigen::MatrixXd& part : parts) {
        strains.middleCols(begin, part.cols()) = part;
        begin += part.cols();
      }
      if (sum.size() == 0) sum = Eigen::MatrixXd::Zero(size, size);
      sum += rule.weights(p) * rule.weights(q) * std::abs(shape.jacobian(at).determinant()) * strains.transpose() *
             weight * strains;
    }
  return sum;
}

}  // namespace

TEST_CASE("sum factorisation gives the form that summing over points does") {
  const RitzBasis values(5, RitzBasis::Ends::values), slopes(6, RitzBasis::Ends::slopes);
  FormField u{&values, Eigen::MatrixXd::Random(4, derivative_count)};
  FormField w{&slopes, Eigen::MatrixXd::Random(4, derivative_count)};
  FormField v{&values, Eigen::MatrixXd::Zero(4, derivative_count)};
  v.operators(3, 1) = 2;
  Eigen::MatrixXd weight = Eigen::MatrixXd::Random(4, 4);
  weight = (weight * weight.transpose()).eval();
  const std::vector<FormField> fields{u, w, v};
  const Eigen::MatrixXd fast = tensor_form(fields, weight, trapezoid, 9),
                        slow = by_points(fields, weight, trapezoid, 9);
  CHECK((fast - slow).norm() < 1e-13 * slow.norm());
  CHECK((fast - fast.transpose()).norm() == 0);
}

TEST_CASE("fields that the weight does not couple give exact zeros") {
  const RitzBasis basis(4, RitzBasis::Ends::values);
  FormField u{&basis, Eigen::MatrixXd::Zero(2, derivative_count)}, v = u;
  u.operators(0, 1) = v.operators(1, 2) = 1;
  CHECK(tensor_form({u, v}, Eigen::Matrix2d::Identity(), trapezoid, 6).bottomLeftCorner(16, 16).isZero(0));
}

TEST_CASE("physical derivatives of polynomials in x and y") {
  // f = x, y, x², xy, y² are polynomials in (ξ, η) too; their reference derivatives by central differences.
  const auto monomials = [](const Eigen::Vector2d& p) {
    Eigen::VectorXd f(6);
    f << 1, p.x(), p.y(), p.x() * p.x(), p.x() * p.y(), p.y() * p.y();
    return f;
  };
  const double h = 1e-3;
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(0.3, -0.6), Eigen::Vector2d(-1, 1), Eigen::Vector2d(0, 0)}) {
    const auto f = [&](double a, double b) { return monomials(trapezoid.position(at + h * Eigen::Vector2d(a, b))); };
    Eigen::MatrixXd reference(derivative_count, 6);
    reference.row(0) = f(0, 0);
    reference.row(1) = (f(1, 0) - f(-1, 0)) / (2 * h);
    reference.row(2) = (f(0, 1) - f(0, -1)) / (2 * h);
    reference.row(3) = (f(1, 0) - 2 * f(0, 0) + f(-1, 0)) / (h * h);
    reference.row(4) = (f(1, 1) - f(1, -1) - f(-1, 1) + f(-1, -1)) / (4 * h * h);
    reference.row(5) = (f(0, 1) - 2 * f(0, 0) + f(0, -1)) / (h * h);
    const Eigen::Vector2d p = trapezoid.position(at);
    Eigen::MatrixXd exact(derivative_count, 6);
    exact << 1, p.x(), p.y(), p.x() * p.x(), p.x() * p.y(), p.y() * p.y(),  //
        0, 1, 0, 2 * p.x(), p.y(), 0,                                       //
        0, 0, 1, 0, p.x(), 2 * p.y(),                                       //
        0, 0, 0, 2, 0, 0,                                                   //
        0, 0, 0, 0, 1, 0,                                                   //
        0, 0, 0, 0, 0, 2;
    // Second differences of second-degree polynomials are exact; rounding is ε/h².
    CHECK((physical_derivatives(trapezoid, at) * reference - exact).norm() < 1e-8);
  }
}

TEST_CASE("the rule is as fine as the Jacobian needs") {
  CHECK(quadrature_points(rectangle(2, 1), 12) == 12);
  const RitzBasis basis(10, RitzBasis::Ends::values);
  FormField w{&basis, Eigen::MatrixXd::Zero(2, derivative_count)};
  w.operators(0, 1) = w.operators(1, 2) = 1;
  for (const double taper : {0.9, 0.5, 0.2, 0.05}) {
    const PlateShape shape{{{{0, -0.5}, {1, -0.5 * taper}, {1, 0.5 * taper}, {0, 0.5}}}};
    const std::size_t points = quadrature_points(shape, 10);
    const Eigen::MatrixXd form = tensor_form({w}, Eigen::Matrix2d::Identity(), shape, points),
                          finer = tensor_form({w}, Eigen::Matrix2d::Identity(), shape, points + 30);
    CAPTURE(taper);
    CHECK((form - finer).norm() < 1e-12 * finer.norm());
  }
  const PlateShape needle{{{{0, -0.5}, {1, -0.01}, {1, 0.01}, {0, 0.5}}}};
  CHECK(quadrature_points(needle, 10) < 220);
}
