#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <cmath>
#include <numbers>
#include <vector>

namespace impulse::test {

/// Dense matrices in the form a Structure holds them.
inline Eigen::SparseMatrix<double> sparse(const Eigen::MatrixXd& a) { return a.sparseView(); }

enum class Ends { fixed, free };

/// n masses m in line, joined by springs k; fixed: springs to the wall at both ends too.
inline Eigen::SparseMatrix<double> chain_stiffness(Eigen::Index n, double k, Ends ends) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool is_end = i == 0 || i == n - 1;
    entries.emplace_back(i, i, ends == Ends::free && is_end ? k : 2 * k);
    if (i > 0) entries.emplace_back(i, i - 1, -k);
    if (i + 1 < n) entries.emplace_back(i, i + 1, -k);
  }
  Eigen::SparseMatrix<double> a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

inline Eigen::SparseMatrix<double> lumped_mass(Eigen::Index n, double m) {
  Eigen::SparseMatrix<double> a(n, n);
  a.setIdentity();
  return m * a;
}

/// Mode j = 0, 1, ...: ω = 2√(k/m) sin((j+1)π/(2(n+1))) between walls, 2√(k/m) sin(jπ/(2n)) free.
inline double chain_frequency(Eigen::Index j, Eigen::Index n, double k, double m, Ends ends) {
  const double angle = ends == Ends::fixed
                           ? static_cast<double>(j + 1) * std::numbers::pi / static_cast<double>(2 * (n + 1))
                           : static_cast<double>(j) * std::numbers::pi / static_cast<double>(2 * n);
  return 2 * std::sqrt(k / m) * std::sin(angle);
}

/// Block diagonal: two bodies side by side.
inline Eigen::SparseMatrix<double> side_by_side(const Eigen::SparseMatrix<double>& a,
                                                const Eigen::SparseMatrix<double>& b) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&entries](const Eigen::SparseMatrix<double>& part, Eigen::Index offset) {
    for (Eigen::Index j = 0; j < part.outerSize(); ++j)
      for (Eigen::SparseMatrix<double>::InnerIterator it(part, j); it; ++it)
        entries.emplace_back(it.row() + offset, it.col() + offset, it.value());
  };
  add(a, 0);
  add(b, a.rows());
  Eigen::SparseMatrix<double> whole(a.rows() + b.rows(), a.cols() + b.cols());
  whole.setFromTriplets(entries.begin(), entries.end());
  return whole;
}

/// K u = λ M u.
struct Pencil {
  Eigen::SparseMatrix<double> k, m;
};

/// Free linear bar, `elements` equal ones, consistent mass: ω_j = √(6 k/m (1 - cos a)/(2 + cos a)), a = jπ/elements,
/// with k = EA/h and m = ρAh of one element.
inline Pencil consistent_bar(Eigen::Index elements, double k, double m) {
  const Eigen::Index n = elements + 1;
  Eigen::SparseMatrix<double> mass(n, n);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index e = 0; e < elements; ++e)
    for (Eigen::Index i = 0; i < 2; ++i)
      for (Eigen::Index j = 0; j < 2; ++j) entries.emplace_back(e + i, e + j, i == j ? m / 3 : m / 6);
  mass.setFromTriplets(entries.begin(), entries.end());
  return {chain_stiffness(n, k, Ends::free), mass};
}

/// Free Euler beam of Hermite elements (w, θ at each node): length, EI, ρA.
inline Pencil free_beam(Eigen::Index elements, double length = 1, double bending = 1, double line_mass = 1) {
  const double h = length / static_cast<double>(elements);
  Eigen::Matrix4d k, m;
  k << 12, 6 * h, -12, 6 * h, 6 * h, 4 * h * h, -6 * h, 2 * h * h, -12, -6 * h, 12, -6 * h, 6 * h, 2 * h * h, -6 * h,
      4 * h * h;
  m << 156, 22 * h, 54, -13 * h, 22 * h, 4 * h * h, 13 * h, -3 * h * h, 54, 13 * h, 156, -22 * h, -13 * h, -3 * h * h,
      -22 * h, 4 * h * h;
  k *= bending / (h * h * h);
  m *= line_mass * h / 420;
  const Eigen::Index n = 2 * (elements + 1);
  std::vector<Eigen::Triplet<double>> k_entries, m_entries;
  for (Eigen::Index e = 0; e < elements; ++e)
    for (Eigen::Index i = 0; i < 4; ++i)
      for (Eigen::Index j = 0; j < 4; ++j) {
        k_entries.emplace_back(2 * e + i, 2 * e + j, k(i, j));
        m_entries.emplace_back(2 * e + i, 2 * e + j, m(i, j));
      }
  Pencil beam{Eigen::SparseMatrix<double>(n, n), Eigen::SparseMatrix<double>(n, n)};
  beam.k.setFromTriplets(k_entries.begin(), k_entries.end());
  beam.m.setFromTriplets(m_entries.begin(), m_entries.end());
  return beam;
}

}  // namespace impulse::test
