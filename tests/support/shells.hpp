#pragma once

#include "fem/shell/shell.hpp"

#include <Eigen/SparseCholesky>

#include <string>

/// Panels for tests.
namespace impulse::shells {

inline Laminate isotropic(double modulus_Pa, double poissons_ratio, double thickness_m, double density_kg_per_m3) {
  Eigen::Matrix3d q;
  q << 1, poissons_ratio, 0, poissons_ratio, 1, 0, 0, 0, (1 - poissons_ratio) / 2;
  q *= modulus_Pa / (1 - poissons_ratio * poissons_ratio);
  const double h = thickness_m;
  Laminate laminate;
  laminate.thickness_m = h;
  laminate.extension = q * h;
  laminate.coupling.setZero();
  laminate.bending = q * h * h * h / 12;
  laminate.transverse_shear.setZero();
  laminate.mass_kg_per_m2 = density_kg_per_m3 * h;
  return laminate;
}

inline ShellPanel panel(PanelShape shape, const Laminate& laminate, const std::string& edges, std::size_t count_x,
                        std::size_t count_y) {
  return {shape, laminate, parse_edges(edges), graded_lines(shape.length_m, count_x, 0, 1),
          graded_lines(shape.width_m, count_y, 0, 1)};
}

inline Eigen::VectorXd rest(const Shell& shell) { return Eigen::VectorXd::Zero(shell.size()); }

inline Eigen::VectorXd linear_solution(const Shell& shell, const Eigen::VectorXd& load) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(shell.tangent(rest(shell)));
  return factor.solve(load);
}

}  // namespace impulse::shells
