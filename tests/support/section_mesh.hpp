#pragma once

#include "fem/mesh/triangle_mesh.hpp"

#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace impulse {

/// Square cells (i, j), 0 ≤ i < columns, 0 ≤ j < rows, each halved into triangles, its corners placed by `at(i, j)` in
/// r, z; sides are straight.
inline TriangleMesh mapped_mesh(int columns, int rows, const std::function<Eigen::RowVector2d(double, double)>& at) {
  TriangleMesh mesh;
  mesh.elements.resize(2 * columns * rows, 6);
  std::map<std::pair<int, int>, Eigen::Index> numbers;
  std::vector<Eigen::RowVector2d> places;
  const auto node = [&](int i, int j) {  // in half cells
    const auto [found, is_new] = numbers.try_emplace({i, j}, static_cast<Eigen::Index>(places.size()));
    if (is_new) {
      const auto corner = [&](int di, int dj) { return at((i + di) / 2, (j + dj) / 2); };
      // A node in the middle of a cell lies on its diagonal.
      places.push_back(0.5 * (corner(0, 0) + corner(i % 2, j % 2)));
    }
    return found->second;
  };
  Eigen::Index e = 0;
  for (int i = 0; i < 2 * columns; i += 2)
    for (int j = 0; j < 2 * rows; j += 2) {
      mesh.elements.row(e++) << node(i, j), node(i + 2, j), node(i + 2, j + 2), node(i + 1, j), node(i + 2, j + 1),
          node(i + 1, j + 1);
      mesh.elements.row(e++) << node(i, j), node(i + 2, j + 2), node(i, j + 2), node(i + 1, j + 1), node(i + 1, j + 2),
          node(i, j + 1);
    }
  mesh.nodes.resize(static_cast<Eigen::Index>(places.size()), 2);
  for (std::size_t k = 0; k < places.size(); ++k) mesh.nodes.row(static_cast<Eigen::Index>(k)) = places[k];
  mesh.region.assign(static_cast<std::size_t>(mesh.element_count()), 0);
  return mesh;
}

/// Rectangle r_1 ≤ r ≤ r_2, 0 ≤ z ≤ length.
inline TriangleMesh rectangle_mesh(double r_1, double r_2, double length, int columns, int rows) {
  return mapped_mesh(columns, rows, [=](double i, double j) {
    return Eigen::RowVector2d(r_1 + (r_2 - r_1) * i / columns, length * j / rows);
  });
}

}  // namespace impulse
