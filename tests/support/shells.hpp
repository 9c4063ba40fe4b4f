#pragma once

#include "fem/shell/shell.hpp"

#include <Eigen/SparseCholesky>

#include <string>

/// Panels for tests.
namespace impulse::shells {

inline Laminate isotropic(double modulus_Pa, double poissons_ratio, double thickness_m, double density_kg_per_m3) {
  return laminate({{isotropic_ply({"", modulus_Pa, density_kg_per_m3, poissons_ratio}), 0, thickness_m}});
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
