#pragma once

#include "fem/shell/shell_panel.hpp"

#include <Eigen/Dense>

#include <vector>

namespace impulse {

/// The displacements that supports leave a node: its 12 degrees of freedom (shell_geometry.hpp) are basis · z, with
/// orthonormal columns, and z are the panel's degrees of freedom from `first` on.
struct SupportedNode {
  Eigen::Matrix<double, 12, Eigen::Dynamic> basis;
  Eigen::Index first = 0;
};

/// Every node, x fastest. A condition c(τ)·u = 0 along an edge is c·u = 0 and (c·u)_,τ = 0 at each of its nodes, so
/// that it also holds between them where c is constant, and to the order of the interpolation where c turns. The
/// rotation n·u_,ν = 0 likewise: n·u_,ν = 0 and n_,τ·u_,ν + n·u_,ντ = 0; where the edge is curved that leaves the
/// membrane shear of u_,ντ free, which holding all of u_,ν would not.
/// Verified by: tests/fem/shell_supports.test.cpp
[[nodiscard]] std::vector<SupportedNode> supported_nodes(const ShellPanel& panel);

}  // namespace impulse
