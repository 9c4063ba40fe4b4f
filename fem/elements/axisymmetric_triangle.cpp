#include "fem/elements/axisymmetric_triangle.hpp"

#include "lib/contract/require.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace impulse {
namespace {

using Shape = Eigen::Matrix<double, 6, 1>;
using ShapeGradient = Eigen::Matrix<double, 6, 2>;

/// Area coordinates L₂, L₃ and a weight; weights add up to the reference triangle's area ½.
struct GaussPoint {
  double x;
  double y;
  double weight;
};

/// Radon's rule of degree 5.
std::array<GaussPoint, 7> gauss_points() {
  const double s = std::sqrt(15.0);
  const double a = (6 - s) / 21, b = (6 + s) / 21;
  const double wa = (155 - s) / 2400, wb = (155 + s) / 2400;
  return {{{1.0 / 3, 1.0 / 3, 9.0 / 80},
           {a, a, wa},
           {1 - 2 * a, a, wa},
           {a, 1 - 2 * a, wa},
           {b, b, wb},
           {1 - 2 * b, b, wb},
           {b, 1 - 2 * b, wb}}};
}

Shape shape(double x, double y) {
  const double l = 1 - x - y;
  return {l * (2 * l - 1), x * (2 * x - 1), y * (2 * y - 1), 4 * l * x, 4 * x * y, 4 * y * l};
}

ShapeGradient reference_gradient(double x, double y) {
  const double l = 1 - x - y;
  ShapeGradient d;
  d << 1 - 4 * l, 1 - 4 * l, 4 * x - 1, 0, 0, 4 * y - 1, 4 * (l - x), -4 * x, 4 * y, 4 * x, -4 * y, 4 * (l - y);
  return d;
}

/// What an integrand needs at a Gauss point.
struct Sample {
  Shape n;
  ShapeGradient gradient;  // with respect to r, z
  double r;
  double ring;  // 2πr dA
};

template <class Add>
void integrate(const TriangleNodes& nodes, const Add& add) {
  static const std::array<GaussPoint, 7> points = gauss_points();
  for (const GaussPoint& point : points) {
    const Shape n = shape(point.x, point.y);
    const ShapeGradient reference = reference_gradient(point.x, point.y);
    const Eigen::Matrix2d jacobian = reference.transpose() * nodes;
    const double determinant = jacobian.determinant();
    const Eigen::RowVector2d at = n.transpose() * nodes;
    require(
        determinant > 0,
        "a triangle is turned inside out near r = {:.6g} m, z = {:.6g} m; its corners must run counterclockwise and "
        "the nodes between them lie near the middle of the sides",
        at(0), at(1));
    require(at(0) > 0, "a triangle reaches across the axis, to r = {:.6g} m at z = {:.6g} m", at(0), at(1));
    const ShapeGradient gradient = reference * jacobian.inverse().transpose();
    add(Sample{n, gradient, at(0), 2 * std::numbers::pi * at(0) * determinant * point.weight});
  }
}

Eigen::Matrix<double, 4, 12> strain_matrix(const Sample& sample) {
  Eigen::Matrix<double, 4, 12> b = Eigen::Matrix<double, 4, 12>::Zero();
  for (Eigen::Index i = 0; i < 6; ++i) {
    b(0, 2 * i) = b(3, 2 * i + 1) = sample.gradient(i, 0);
    b(1, 2 * i) = sample.n(i) / sample.r;
    b(2, 2 * i + 1) = b(3, 2 * i) = sample.gradient(i, 1);
  }
  return b;
}

}  // namespace

TriangleMatrix axisymmetric_triangle_stiffness(const TriangleNodes& nodes, const AxisymmetricElasticity& material) {
  TriangleMatrix k = TriangleMatrix::Zero();
  integrate(nodes, [&](const Sample& sample) {
    const Eigen::Matrix<double, 4, 12> b = strain_matrix(sample);
    const Eigen::Matrix<double, 4, 12> stress = sample.ring * (material.stiffness * b);
    k.noalias() += b.transpose() * stress;
  });
  return 0.5 * (k + k.transpose());
}

TriangleMatrix axisymmetric_triangle_consistent_mass(const TriangleNodes& nodes, double density_kg_per_m3) {
  Eigen::Matrix<double, 6, 6> scalar = Eigen::Matrix<double, 6, 6>::Zero();
  integrate(nodes, [&](const Sample& sample) {
    // The square first: then the sum is symmetric to the last bit.
    const Eigen::Matrix<double, 6, 6> square = sample.n * sample.n.transpose();
    scalar += (density_kg_per_m3 * sample.ring) * square;
  });
  TriangleMatrix m = TriangleMatrix::Zero();
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < 6; ++j) m(2 * i, 2 * j) = m(2 * i + 1, 2 * j + 1) = scalar(i, j);
  return m;
}

TriangleVector axisymmetric_triangle_lumped_mass(const TriangleNodes& nodes, double density_kg_per_m3) {
  Shape diagonal = Shape::Zero();
  double mass = 0;
  integrate(nodes, [&](const Sample& sample) {
    diagonal += (density_kg_per_m3 * sample.ring) * sample.n.cwiseAbs2();
    mass += density_kg_per_m3 * sample.ring;
  });
  TriangleVector lumped;
  for (Eigen::Index i = 0; i < 6; ++i) lumped(2 * i) = lumped(2 * i + 1) = diagonal(i) * mass / diagonal.sum();
  return lumped;
}

Eigen::Vector3d axisymmetric_side_load(double r_1_m, double r_2_m) {
  const double factor = std::numbers::pi / 3 * std::abs(r_2_m - r_1_m);
  return factor * Eigen::Vector3d(r_1_m, r_2_m, 2 * (r_1_m + r_2_m));
}

}  // namespace impulse
