#pragma once

#include <Eigen/Dense>

#include <cstddef>
#include <vector>

namespace impulse {

/// Half a meridian section as 6-node triangles.
struct TriangleMesh {
  Eigen::Matrix<double, Eigen::Dynamic, 2> nodes;           ///< r, z [m]
  Eigen::Matrix<Eigen::Index, Eigen::Dynamic, 6> elements;  ///< nodes in the order of TriangleNodes
  std::vector<std::size_t> region;                          ///< of each element, from 0: which material it is of

  [[nodiscard]] Eigen::Index node_count() const { return nodes.rows(); }
  [[nodiscard]] Eigen::Index element_count() const { return elements.rows(); }
};

}  // namespace impulse
