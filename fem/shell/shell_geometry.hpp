#pragma once

#include "fem/shell/hermite.hpp"
#include "fem/shell/shell_kernel.hpp"
#include "fem/shell/shell_panel.hpp"

#include <Eigen/Dense>

#include <array>
#include <vector>

namespace impulse {

using Coefficients = Eigen::Matrix<double, 16, 3>;  ///< of the Hermite functions 4b + a, for each component
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Values of the 16 functions a(t1) b(t2) and their derivatives at a point of an element.
struct ShellFunctions {
  Eigen::Matrix<double, 16, 1> value, d1, d2, d11, d12, d22;
};

[[nodiscard]] ShellFunctions shell_functions(double t1, double t2);

/// At the Gauss points, in the order of shell_gauss_points.
[[nodiscard]] const std::array<ShellFunctions, shell_gauss_points>& shell_functions_at_gauss_points();

[[nodiscard]] constexpr double shell_gauss_weight(std::size_t point) {
  return gauss_weight[point % 4] * gauss_weight[point / 4];
}

/// The stress-free surface at a point of an element, derivatives by t1 and t2 (0 to 1 across the element).
struct ShellPoint {
  Eigen::Vector3d a1, a2, n;          ///< tangents r_,1, r_,2 and unit normal
  Eigen::Matrix<double, 3, 2> gamma;  ///< Γ^λ_11, Γ^λ_22, 2Γ^λ_12; column λ
  Eigen::Matrix3d to_axes;            ///< (ε11, ε22, 2ε12) to strains along e1 = a1/|a1| and e2 = n × e1
  double area = 0;                    ///< |a1 × a2|
};

[[nodiscard]] ShellPoint shell_point(const ShellFunctions& functions, const Coefficients& surface);

/// (ε11, ε22, 2ε12, κ11, κ22, 2κ12) as defined in shell_kernel.hpp.
[[nodiscard]] Eigen::Matrix<double, 6, 1> shell_strain(const ShellPoint& point, const ShellFunctions& functions,
                                                       const Coefficients& displacement);

/// An element: coefficient (c, 4b + a) is scale[4b + a] times degree of freedom dof[4b + a] + 4c of the unrestrained
/// panel, whose node k holds 12k + 4c + (0: u_c, 1: u_c,x, 2: u_c,y, 3: u_c,xy).
struct ShellElement {
  std::array<int, 4> nodes;
  std::array<int, 16> dof;
  std::array<double, 16> scale;
  Coefficients surface;
};

/// The coefficients of an element from nodal values.
[[nodiscard]] Coefficients coefficients_of(const ShellElement& element, const Eigen::VectorXd& values);

/// Elements row by row, x fastest, as are the nodes. @throws std::invalid_argument if the surface degenerates.
[[nodiscard]] std::vector<ShellElement> shell_elements(const ShellPanel& panel);

}  // namespace impulse
