#include "fem/shell/shell_geometry.hpp"

#include "lib/contract/require.hpp"

namespace impulse {
namespace {

using Functions = Eigen::Matrix<double, 16, 1>;

Functions products(const std::array<double, 4>& along_1, const std::array<double, 4>& along_2) {
  Functions f;
  for (int b = 0; b < 4; ++b)
    for (int a = 0; a < 4; ++a)
      f(4 * b + a) = along_1[static_cast<std::size_t>(a)] * along_2[static_cast<std::size_t>(b)];
  return f;
}

}  // namespace

ShellFunctions shell_functions(double t1, double t2) {
  const CubicHermite f = cubic_hermite(t1), g = cubic_hermite(t2);
  return {products(f.value, g.value),  products(f.first, g.value), products(f.value, g.first),
          products(f.second, g.value), products(f.first, g.first), products(f.value, g.second)};
}

const std::array<ShellFunctions, shell_gauss_points>& shell_functions_at_gauss_points() {
  static const std::array<ShellFunctions, shell_gauss_points> functions = [] {
    std::array<ShellFunctions, shell_gauss_points> all;
    for (std::size_t p = 0; p < shell_gauss_points; ++p)
      all[p] = shell_functions(gauss_point[p % 4], gauss_point[p / 4]);
    return all;
  }();
  return functions;
}

ShellPoint shell_point(const ShellFunctions& functions, const Coefficients& surface) {
  ShellPoint point;
  point.a1 = surface.transpose() * functions.d1;
  point.a2 = surface.transpose() * functions.d2;
  const Eigen::Vector3d across = point.a1.cross(point.a2);
  point.area = across.norm();
  point.n = across / point.area;
  // Dual tangents: a^α·a_β = δ.
  const Eigen::Vector3d dual_1 = point.a2.cross(point.n) / point.area;
  const Eigen::Vector3d dual_2 = point.n.cross(point.a1) / point.area;
  Eigen::Matrix3d second;
  second << surface.transpose() * functions.d11, surface.transpose() * functions.d22,
      2 * surface.transpose() * functions.d12;
  point.gamma.col(0) = second.transpose() * dual_1;
  point.gamma.col(1) = second.transpose() * dual_2;
  const Eigen::Vector3d e1 = point.a1.normalized(), e2 = point.n.cross(e1);
  const double c11 = dual_1.dot(e1), c12 = dual_1.dot(e2), c21 = dual_2.dot(e1), c22 = dual_2.dot(e2);
  point.to_axes << c11 * c11, c21 * c21, c11 * c21, c12 * c12, c22 * c22, c12 * c22, 2 * c11 * c12, 2 * c21 * c22,
      c11 * c22 + c21 * c12;
  return point;
}

Eigen::Matrix<double, 6, 1> shell_strain(const ShellPoint& point, const ShellFunctions& functions,
                                         const Coefficients& displacement) {
  const Eigen::Vector3d u1 = displacement.transpose() * functions.d1, u2 = displacement.transpose() * functions.d2;
  const Eigen::Matrix<double, 16, 1> normal = displacement * point.n;
  const double n1 = point.n.dot(u1), n2 = point.n.dot(u2);
  Eigen::Matrix<double, 6, 1> strain;
  strain.head<3>() << point.a1.dot(u1) + u1.dot(u1) / 2, point.a2.dot(u2) + u2.dot(u2) / 2,
      point.a1.dot(u2) + point.a2.dot(u1) + u1.dot(u2);
  strain.tail<3>() = point.gamma.col(0) * n1 + point.gamma.col(1) * n2;
  strain.tail<3>() -=
      Eigen::Vector3d(functions.d11.dot(normal), functions.d22.dot(normal), 2 * functions.d12.dot(normal));
  return strain;
}

Coefficients coefficients_of(const ShellElement& element, const Eigen::VectorXd& values) {
  Coefficients q;
  for (std::size_t k = 0; k < 16; ++k)
    for (int c = 0; c < 3; ++c) q(static_cast<Eigen::Index>(k), c) = element.scale[k] * values(element.dof[k] + 4 * c);
  return q;
}

std::vector<ShellElement> shell_elements(const ShellPanel& panel) {
  const std::vector<double>&x = panel.lines_x, &y = panel.lines_y;
  std::vector<HermiteNode> nodes;
  for (double yj : y)
    for (double xi : x) nodes.push_back(mid_surface(panel.shape, xi, yj));
  std::vector<ShellElement> elements;
  for (std::size_t j = 0; j + 1 < y.size(); ++j)
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      ShellElement element;
      for (std::size_t k = 0; k < 4; ++k) element.nodes[k] = static_cast<int>((j + k / 2) * x.size() + i + k % 2);
      for (std::size_t b = 0; b < 4; ++b)
        for (std::size_t a = 0; a < 4; ++a) {
          const int node = element.nodes[2 * (b / 2) + a / 2];
          const auto kind = static_cast<int>(2 * (b % 2) + a % 2);
          const double scale = (a % 2 == 1 ? x[i + 1] - x[i] : 1) * (b % 2 == 1 ? y[j + 1] - y[j] : 1);
          element.dof[4 * b + a] = 12 * node + kind;
          element.scale[4 * b + a] = scale;
          element.surface.row(static_cast<Eigen::Index>(4 * b + a)) =
              scale * nodes[static_cast<std::size_t>(node)].col(kind).transpose();
        }
      elements.push_back(element);
    }
  return elements;
}

}  // namespace impulse
