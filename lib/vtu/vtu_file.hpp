#pragma once

#include <Eigen/Dense>

#include <string>
#include <vector>

namespace impulse {

/// Kinds of cells by VTK's numbers; nodes in VTK's order.
enum class VtuCell : int {
  line = 3,
  quadrilateral = 9,
  quadratic_triangle = 22,  ///< corners counterclockwise, then the nodes between 1-2, 2-3, 3-1
};

/// Points and cells of one kind.
struct VtuGrid {
  Eigen::Matrix<double, Eigen::Dynamic, 3> points;                    ///< [m]
  Eigen::Matrix<Eigen::Index, Eigen::Dynamic, Eigen::Dynamic> cells;  ///< a row of point numbers each
  VtuCell kind = VtuCell::quadrilateral;
};

/// Numbers at the points, or on the cells: a row each, of 1 component or 3.
struct VtuField {
  std::string name;  ///< with its unit
  Eigen::MatrixXd values;
};

/// Writes an unstructured grid with fields as a VTK XML file (`.vtu`, as text), which ParaView and VisIt open. The
/// fields of points and of cells keep their order. Path as OutputFile; numbers with the shortest digits that read back
/// the same.
/// @throws std::invalid_argument if sizes disagree or a value is not finite; OutputError.
/// Verified by: tests/lib/vtu_file.test.cpp
void write_vtu(const std::string& path, const VtuGrid& grid, const std::vector<VtuField>& point_fields,
               const std::vector<VtuField>& cell_fields = {});

}  // namespace impulse
