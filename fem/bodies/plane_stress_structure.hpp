#pragma once

#include "fem/elements/mass_matrix.hpp"
#include "fem/elements/plane_stress.hpp"
#include "lib/model/structure.hpp"

#include <Eigen/Dense>

#include <cstddef>
#include <vector>

namespace impulse {

/// A quadrilateral divided into `along` × `across` quadrilaterals by the bilinear map of its corners. Node (i, j) =
/// i (across + 1) + j lies at ξ = i/along from edge 4-1 to edge 2-3, η = j/across from edge 1-2 to edge 4-3.
struct MappedMesh {
  QuadrilateralCorners corners;
  std::size_t along = 1;
  std::size_t across = 1;

  [[nodiscard]] Eigen::Index node_count() const { return static_cast<Eigen::Index>((along + 1) * (across + 1)); }
  [[nodiscard]] Eigen::Index node(std::size_t i, std::size_t j) const {
    return static_cast<Eigen::Index>(i * (across + 1) + j);
  }
  [[nodiscard]] Eigen::RowVector2d position(std::size_t i, std::size_t j) const;
};

/// A sheet in plane stress on a mesh; degree of freedom 2·node is u, 2·node + 1 is v.
struct Sheet {
  MappedMesh mesh;
  Material material;
  double thickness_m = 0;
  Quadrilateral element = Quadrilateral::bilinear;
  MassMatrix mass = MassMatrix::consistent;
  std::vector<Eigen::Index> held;  ///< degrees of freedom that are zero
};

/// Matrices of a sheet. `functionals` (2·node_count × p) become its contacts, without the rows of held degrees of
/// freedom; the wave admittance is zero.
/// @throws std::invalid_argument as the element, and unless there are 1 to 1e6 elements and the thickness and the
/// density are positive. Verified by: tests/fem/plane_stress_structure.test.cpp
[[nodiscard]] Structure plane_stress_structure(const Sheet& sheet, const Eigen::MatrixXd& functionals);

}  // namespace impulse
