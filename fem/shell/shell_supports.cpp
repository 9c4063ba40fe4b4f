#include "fem/shell/shell_supports.hpp"

#include <Eigen/Geometry>

namespace impulse {
namespace {

using Eigen::Vector3d;
using Row = Eigen::Matrix<double, 1, 12>;
using Rows = std::vector<Row>;

enum class Along { x, y };

/// A direction along an edge and its derivative there.
struct Field {
  Vector3d value, slope;
};

/// Columns ν, τ, n of an edge along x or y.
Eigen::Matrix3d triad(const PanelShape& shape, double x, double y, Along along) {
  const HermiteNode r = mid_surface(shape, x, y);
  const Vector3d tau = (along == Along::x ? r.col(1) : r.col(2)).normalized();
  const Vector3d n = Vector3d(r.col(1)).cross(Vector3d(r.col(2))).normalized();
  Eigen::Matrix3d axes;
  axes << tau.cross(n), tau, n;
  return axes;
}

/// The mid-surface is analytic beyond the panel too, and this difference is of fourth order: the error is rounding,
/// 1e-12 of a turn per length.
Field field(const PanelShape& shape, double x, double y, Along along, int column) {
  const double d = 1e-3 * (along == Along::x ? shape.length_m : shape.width_m);
  const auto at = [&](double steps) -> Vector3d {
    const double s = steps * d;
    return triad(shape, along == Along::x ? x + s : x, along == Along::y ? y + s : y, along).col(column);
  };
  return {at(0), (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * d)};
}

Row row_of(int kind, const Vector3d& direction) {
  Row row = Row::Zero();
  for (int c = 0; c < 3; ++c) row(4 * c + kind) = direction(c);
  return row;
}

/// c·f = 0 along the edge for f = u (kind 0) or u_,ν; `along_kind` is that of f's derivative along the edge.
void hold(Rows& rows, const Field& c, int kind, int along_kind) {
  rows.push_back(row_of(kind, c.value));
  rows.push_back(row_of(kind, c.slope) + row_of(along_kind, c.value));
}

void hold_edge(Rows& rows, const PanelShape& shape, double x, double y, Along along, EdgeSupport support) {
  if (support == EdgeSupport::free) return;
  const int tangential = along == Along::x ? 1 : 2, across = 3 - tangential;
  PanelShape ideal = shape;
  ideal.imperfection = {};
  const auto hold_column = [&](int column) { hold(rows, field(ideal, x, y, along, column), 0, tangential); };
  if (support == EdgeSupport::clamped || support == EdgeSupport::immovable) {
    for (int c = 0; c < 3; ++c) hold(rows, {Vector3d::Unit(c), Vector3d::Zero()}, 0, tangential);
  } else {
    if (support == EdgeSupport::held_across || support == EdgeSupport::symmetric) hold_column(0);
    if (support == EdgeSupport::held_along) hold_column(1);
    if (support != EdgeSupport::symmetric) hold_column(2);
  }
  if (support == EdgeSupport::clamped || support == EdgeSupport::symmetric)
    hold(rows, field(shape, x, y, along, 2), across, 3);
}

/// Orthonormal basis of what the rows leave. Reflections of unit vectors are unit vectors, so a node whose conditions
/// concern single degrees of freedom keeps the others as they are.
Eigen::Matrix<double, 12, Eigen::Dynamic> free_basis(const Rows& rows) {
  if (rows.empty()) return Eigen::Matrix<double, 12, 12>::Identity();
  Eigen::MatrixXd conditions(12, rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    conditions.col(static_cast<Eigen::Index>(i)) = rows[i].transpose().normalized();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(conditions);
  qr.setThreshold(1e-8);
  Eigen::MatrixXd q = qr.householderQ();
  Eigen::MatrixXd basis = q.rightCols(12 - qr.rank());
  return (basis.array().abs() < 1e-14).select(0.0, basis);
}

}  // namespace

std::vector<SupportedNode> supported_nodes(const ShellPanel& panel) {
  const std::size_t nx = panel.lines_x.size(), ny = panel.lines_y.size();
  std::vector<SupportedNode> nodes;
  Eigen::Index first = 0;
  for (std::size_t j = 0; j < ny; ++j)
    for (std::size_t i = 0; i < nx; ++i) {
      Rows rows;
      const double x = panel.lines_x[i], y = panel.lines_y[j];
      if (j == 0) hold_edge(rows, panel.shape, x, y, Along::x, panel.edges[0]);
      if (i + 1 == nx) hold_edge(rows, panel.shape, x, y, Along::y, panel.edges[1]);
      if (j + 1 == ny) hold_edge(rows, panel.shape, x, y, Along::x, panel.edges[2]);
      if (i == 0) hold_edge(rows, panel.shape, x, y, Along::y, panel.edges[3]);
      nodes.push_back({free_basis(rows), first});
      first += nodes.back().basis.cols();
    }
  return nodes;
}

}  // namespace impulse
