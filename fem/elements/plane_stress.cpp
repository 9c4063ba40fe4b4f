#include "fem/elements/plane_stress.hpp"

#include "lib/contract/require.hpp"

#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>

namespace impulse {
namespace {

/// ∂N/∂ξ and ∂N/∂η of the four corners, in two rows.
Eigen::Matrix<double, 2, 4> natural_derivatives(double xi, double eta) {
  Eigen::Matrix<double, 2, 4> d;
  d << -(1 - eta), 1 - eta, 1 + eta, -(1 + eta),  //
      -(1 - xi), -(1 + xi), 1 + xi, 1 - xi;
  return d / 4;
}

Eigen::Vector4d shape(double xi, double eta) {
  return Eigen::Vector4d{(1 - xi) * (1 - eta), (1 + xi) * (1 - eta), (1 + xi) * (1 + eta), (1 - xi) * (1 + eta)} / 4;
}

struct GaussPoint {
  double xi;
  double eta;
};

std::array<GaussPoint, 4> gauss_points() {
  const double g = 1 / std::sqrt(3.0);
  return {{{-g, -g}, {g, -g}, {g, g}, {-g, g}}};
}

/// ∂(x, y)/∂(ξ, η) with one row per natural coordinate.
Eigen::Matrix2d jacobian(const QuadrilateralCorners& corners, double xi, double eta) {
  return natural_derivatives(xi, eta) * corners;
}

void require_convex(const QuadrilateralCorners& corners) {
  require(corners.allFinite(), "a corner of a quadrilateral is not finite");
  // The determinant is bilinear, so it is positive inside if it is at the corners.
  for (const GaussPoint& corner : {GaussPoint{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const double determinant = jacobian(corners, corner.xi, corner.eta).determinant();
    require(determinant > 0,
            "the quadrilateral with a corner at ({}, {}) is not convex and counter-clockwise (Jacobian {})",
            corners(0, 0), corners(0, 1), determinant);
  }
}

Eigen::Matrix3d plane_stress_elasticity(const Material& material) {
  require(material.poissons_ratio.has_value(),
          "plane stress needs Poisson's ratio, and material '{}' has none; give it as {}:0.3", material.name,
          material.name);
  const double nu = *material.poissons_ratio;
  require(nu > -1 && nu < 0.5, "Poisson's ratio {} is outside (-1, 0.5)", nu);
  Eigen::Matrix3d d;
  d << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
  return material.youngs_modulus_Pa / (1 - nu * nu) * d;
}

/// Strains (ε_x, ε_y, γ_xy) of displacements whose derivatives with respect to x and y are the two rows of `gradient`.
template <int functions>
Eigen::Matrix<double, 3, 2 * functions> strains(const Eigen::Matrix<double, 2, functions>& gradient) {
  Eigen::Matrix<double, 3, 2 * functions> b = Eigen::Matrix<double, 3, 2 * functions>::Zero();
  for (int i = 0; i < functions; ++i) {
    b(0, 2 * i) = gradient(0, i);
    b(1, 2 * i + 1) = gradient(1, i);
    b(2, 2 * i) = gradient(1, i);
    b(2, 2 * i + 1) = gradient(0, i);
  }
  return b;
}

}  // namespace

QuadrilateralMatrix plane_stress_stiffness(const QuadrilateralCorners& corners, const Material& material,
                                           double thickness_m, Quadrilateral kind) {
  require_convex(corners);
  const Eigen::Matrix3d elasticity = plane_stress_elasticity(material);
  const Eigen::Matrix2d centre = jacobian(corners, 0, 0);
  QuadrilateralMatrix k = QuadrilateralMatrix::Zero();
  Eigen::Matrix<double, 8, 4> coupling = Eigen::Matrix<double, 8, 4>::Zero();
  Eigen::Matrix4d internal = Eigen::Matrix4d::Zero();
  for (const GaussPoint& point : gauss_points()) {
    const Eigen::Matrix2d here = jacobian(corners, point.xi, point.eta);
    const double determinant = here.determinant();
    const double weight = thickness_m * determinant;
    const Eigen::Matrix<double, 2, 4> gradient = here.inverse() * natural_derivatives(point.xi, point.eta);
    const Eigen::Matrix<double, 3, 8> b = strains<4>(gradient);
    k += weight * b.transpose() * elasticity * b;
    Eigen::Matrix2d natural;
    natural << -2 * point.xi, 0, 0, -2 * point.eta;
    const Eigen::Matrix2d bending = centre.determinant() / determinant * (centre.inverse() * natural);
    const Eigen::Matrix<double, 3, 4> g = strains<2>(bending);
    coupling += weight * b.transpose() * elasticity * g;
    internal += weight * g.transpose() * elasticity * g;
  }
  if (kind == Quadrilateral::incompatible) k -= coupling * internal.llt().solve(coupling.transpose());
  return k;
}

QuadrilateralMatrix plane_stress_consistent_mass(const QuadrilateralCorners& corners, double density_kg_per_m3,
                                                 double thickness_m) {
  require_convex(corners);
  Eigen::Matrix4d scalar = Eigen::Matrix4d::Zero();
  for (const GaussPoint& point : gauss_points()) {
    const Eigen::Vector4d n = shape(point.xi, point.eta);
    scalar +=
        density_kg_per_m3 * thickness_m * jacobian(corners, point.xi, point.eta).determinant() * n * n.transpose();
  }
  QuadrilateralMatrix mass = QuadrilateralMatrix::Zero();
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index j = 0; j < 4; ++j) mass(2 * i, 2 * j) = mass(2 * i + 1, 2 * j + 1) = scalar(i, j);
  return mass;
}

Eigen::Vector4d plane_stress_lumped_mass(const QuadrilateralCorners& corners, double density_kg_per_m3,
                                         double thickness_m) {
  require_convex(corners);
  Eigen::Vector4d mass = Eigen::Vector4d::Zero();
  for (const GaussPoint& point : gauss_points())
    mass += density_kg_per_m3 * thickness_m * jacobian(corners, point.xi, point.eta).determinant() *
            shape(point.xi, point.eta);
  return mass;
}

double plane_stress_highest_frequency(const QuadrilateralCorners& corners, const Material& material,
                                      Quadrilateral kind) {
  const Eigen::Vector4d mass = plane_stress_lumped_mass(corners, material.density_kg_per_m3, 1);
  Eigen::Matrix<double, 8, 1> root;
  for (Eigen::Index i = 0; i < 8; ++i) root(i) = 1 / std::sqrt(mass(i / 2));
  const QuadrilateralMatrix scaled =
      root.asDiagonal() * plane_stress_stiffness(corners, material, 1, kind) * root.asDiagonal();
  return std::sqrt(Eigen::SelfAdjointEigenSolver<QuadrilateralMatrix>(scaled, Eigen::EigenvaluesOnly).eigenvalues()(7));
}

}  // namespace impulse
