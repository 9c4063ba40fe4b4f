#include "fem/shell/shell.hpp"

#include "lib/contract/require.hpp"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>

namespace impulse {
namespace {

constexpr std::size_t batch_numbers = shell_gauss_points * shell_point_numbers * shell_lanes;

/// C of the kernel: the laminate's rigidity turned from the fibres' axes to the element's, times the area.
Matrix6d rigidity(const Laminate& laminate, const ShellPoint& point, double point_weight) {
  Matrix6d turned;
  const Eigen::Matrix3d& t = point.to_axes;
  turned << t.transpose() * laminate.extension * t, t.transpose() * laminate.coupling * t,
      t.transpose() * laminate.coupling * t, t.transpose() * laminate.bending * t;
  return turned * (point.area * point_weight);
}

void write_point(const ShellPoint& point, const Matrix6d& c, double* numbers) {
  const auto put = [&numbers](double value) {
    *numbers = value;
    numbers += shell_lanes;
  };
  for (const Eigen::Vector3d& v : {point.a1, point.a2, point.n})
    for (int k = 0; k < 3; ++k) put(v(k));
  for (int l = 0; l < 2; ++l)
    for (int k = 0; k < 3; ++k) put(point.gamma(k, l));
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) put(c(i, j));
}

std::size_t interval(const std::vector<double>& lines, double x) {
  const auto above = std::upper_bound(lines.begin() + 1, lines.end() - 1, x);
  return static_cast<std::size_t>(above - lines.begin()) - 1;
}

}  // namespace

void Shell::AlignedFree::operator()(double* memory) const { std::free(memory); }

/// A point of the panel as one of an element.
struct Shell::Site {
  const ShellElement& element;
  ShellFunctions functions;
};

Shell::Shell(const ShellPanel& panel) : panel_(panel) {
  require_valid(panel);
  elements_ = shell_elements(panel);
  nodes_ = supported_nodes(panel);
  const Eigen::Index size = nodes_.back().first + nodes_.back().basis.cols();
  require(size > 0, "the supports leave nothing of the panel to move; use more elements or fewer supports");
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    for (Eigen::Index j = 0; j < nodes_[k].basis.cols(); ++j)
      for (Eigen::Index i = 0; i < 12; ++i)
        if (nodes_[k].basis(i, j) != 0)
          entries.emplace_back(12 * static_cast<Eigen::Index>(k) + i, nodes_[k].first + j, nodes_[k].basis(i, j));
  unrestrained_.resize(12 * static_cast<Eigen::Index>(nodes_.size()) + 1, size);
  unrestrained_.setFromTriplets(entries.begin(), entries.end());
  restrained_ = unrestrained_.transpose();
  const auto& functions = shell_functions_at_gauss_points();
  for (const ShellElement& element : elements_)
    for (std::size_t p = 0; p < shell_gauss_points; ++p) {
      points_.push_back(shell_point(functions[p], element.surface));
      require(points_.back().area > 0 && std::isfinite(points_.back().area),
              "the panel's surface folds over in an element; use a smaller imperfection or a finer mesh");
      rigidity_.push_back(rigidity(panel.laminate, points_.back(), shell_gauss_weight(p)));
    }
  pack_geometry();
  make_pattern();
}

void Shell::pack_geometry() {
  const std::size_t batches = (elements_.size() + shell_lanes - 1) / shell_lanes;
  packed_.reset(static_cast<double*>(std::aligned_alloc(64, batches * batch_numbers * sizeof(double))));
  if (!packed_) throw std::bad_alloc();
  std::fill_n(packed_.get(), batches * batch_numbers, 0.0);
  // Lanes without an element read and write the row past the last node's.
  gather_dof_.assign(batches * shell_coefficients * shell_lanes, static_cast<int>(unrestrained_.rows()) - 1);
  gather_scale_.assign(gather_dof_.size(), 0.0);
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const std::size_t batch = e / shell_lanes, lane = e % shell_lanes;
    for (std::size_t p = 0; p < shell_gauss_points; ++p)
      write_point(points_[shell_gauss_points * e + p], rigidity_[shell_gauss_points * e + p],
                  packed_.get() + batch * batch_numbers + p * shell_point_numbers * shell_lanes + lane);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 16; ++k) {
        const std::size_t at = (batch * shell_coefficients + 16 * c + k) * shell_lanes + lane;
        gather_dof_[at] = elements_[e].dof[k] + 4 * static_cast<int>(c);
        gather_scale_[at] = elements_[e].scale[k];
      }
  }
}

ShellForce Shell::internal(const Eigen::VectorXd& z) const {
  static const ShellKernel kernel = fastest_shell_kernel();
  constexpr std::size_t numbers = shell_coefficients * shell_lanes;
  const Eigen::VectorXd values = unrestrained_ * z;
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(values.size());
  ShellForce result;
  alignas(64) std::array<double, numbers> q, f;
  const std::size_t batches = gather_dof_.size() / numbers;
  for (std::size_t batch = 0; batch < batches; ++batch) {
    const int* dof = gather_dof_.data() + batch * numbers;
    const double* scale = gather_scale_.data() + batch * numbers;
    for (std::size_t k = 0; k < numbers; ++k) q[k] = scale[k] * values.data()[dof[k]];
    result.energy_J += kernel(packed_.get() + batch * batch_numbers, q.data(), f.data());
    for (std::size_t k = 0; k < numbers; ++k) forces.data()[dof[k]] += scale[k] * f[k];
  }
  result.force = restrained_ * forces;
  return result;
}

Shell::Site Shell::site(const PanelPoint& point) const {
  const std::vector<double>&x = panel_.lines_x, &y = panel_.lines_y;
  require(point.x_m >= 0 && point.x_m <= x.back() && point.y_m >= 0 && point.y_m <= y.back(),
          "the point ({} m, {} m) is outside the panel of {} m x {} m", point.x_m, point.y_m, x.back(), y.back());
  const std::size_t i = interval(x, point.x_m), j = interval(y, point.y_m);
  return {elements_[j * (x.size() - 1) + i],
          shell_functions((point.x_m - x[i]) / (x[i + 1] - x[i]), (point.y_m - y[j]) / (y[j + 1] - y[j]))};
}

Eigen::VectorXd Shell::displacement_functional(const PanelPoint& point, const Eigen::Vector3d& direction) const {
  const Site at = site(point);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(unrestrained_.rows());
  for (std::size_t k = 0; k < 16; ++k)
    for (int c = 0; c < 3; ++c)
      values(at.element.dof[k] + 4 * c) +=
          at.element.scale[k] * at.functions.value(static_cast<Eigen::Index>(k)) * direction(c);
  return restrained_ * values;
}

Eigen::Vector3d Shell::normal(const PanelPoint& point) const {
  const Site at = site(point);
  return shell_point(at.functions, at.element.surface).n;
}

Eigen::Vector3d Shell::place(const PanelPoint& point) const {
  const Site at = site(point);
  return at.element.surface.transpose() * at.functions.value;
}

Eigen::Vector3d Shell::displacement(const Eigen::VectorXd& z, const PanelPoint& point) const {
  const Site at = site(point);
  return coefficients_of(at.element, unrestrained_ * z).transpose() * at.functions.value;
}

ShellStrain Shell::strain(const Eigen::VectorXd& z, const PanelPoint& point) const {
  const Site at = site(point);
  const ShellPoint geometry = shell_point(at.functions, at.element.surface);
  const Eigen::Matrix<double, 6, 1> strain =
      shell_strain(geometry, at.functions, coefficients_of(at.element, unrestrained_ * z));
  return {geometry.to_axes * strain.head<3>(), geometry.to_axes * strain.tail<3>()};
}

ShellStrain Shell::small_strain(const Eigen::VectorXd& z, const PanelPoint& point) const {
  const ShellStrain there = strain(z, point), back = strain(-z, point);
  return {(there.membrane - back.membrane) / 2, (there.curvature - back.curvature) / 2};
}

double Shell::area_m2() const {
  double area = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) area += shell_gauss_weight(k % shell_gauss_points) * points_[k].area;
  return area;
}

Eigen::VectorXd Shell::uniform_load(const Eigen::Vector3d& traction) const {
  const auto& functions = shell_functions_at_gauss_points();
  Eigen::VectorXd values = Eigen::VectorXd::Zero(unrestrained_.rows());
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (std::size_t p = 0; p < shell_gauss_points; ++p) {
      const double area = shell_gauss_weight(p) * points_[shell_gauss_points * e + p].area;
      for (std::size_t k = 0; k < 16; ++k)
        for (int c = 0; c < 3; ++c)
          values(elements_[e].dof[k] + 4 * c) +=
              area * elements_[e].scale[k] * functions[p].value(static_cast<Eigen::Index>(k)) * traction(c);
    }
  return restrained_ * values;
}

Eigen::VectorXd Shell::nodal_values(const Eigen::VectorXd& z) const {
  const Eigen::VectorXd values = unrestrained_ * z;
  return values.head(values.size() - 1);
}

Eigen::VectorXd Shell::restrained(const Eigen::VectorXd& values) const {
  require(values.size() == unrestrained_.rows() - 1, "{} nodal values for a panel that has {}", values.size(),
          unrestrained_.rows() - 1);
  Eigen::VectorXd padded(values.size() + 1);
  padded << values, 0;
  return restrained_ * padded;
}

ElasticBody elastic_body(const Shell& shell) {
  return {[&shell](const Eigen::VectorXd& z) { return shell.internal(z).force; },
          [&shell](const Eigen::VectorXd& z) { return shell.tangent(z); },
          shell.mass() / (shell.panel().laminate.mass_kg_per_m2 * shell.area_m2())};
}

Structure shell_structure(const Shell& shell, const std::vector<PanelPoint>& contacts) {
  Structure body;
  body.stiffness = shell.tangent(Eigen::VectorXd::Zero(shell.size()));
  body.mass = shell.mass();
  const auto count = static_cast<Eigen::Index>(contacts.size());
  body.contacts.resize(shell.size(), count);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    body.contacts.col(column) = shell.displacement_functional(contacts[i], shell.normal(contacts[i]));
    require(body.contacts.col(column).cwiseAbs().maxCoeff() > 1e-9,
            "the point ({} m, {} m) is on a support, which doesn't let it move; strike elsewhere", contacts[i].x_m,
            contacts[i].y_m);
  }
  body.outputs = body.contacts;
  body.wave_admittance = Eigen::MatrixXd::Zero(count, count);
  const auto& edges = shell.panel().edges;
  if (count > 0 && std::ranges::all_of(edges, [](EdgeSupport edge) { return edge == EdgeSupport::free; })) {
    // Mr is what the masses need to be moved alike: the load of ρh per area along the normal.
    const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> mass(body.mass);
    body.translation =
        mass.solve(shell.uniform_load(shell.panel().laminate.mass_kg_per_m2 * shell.normal(contacts.front())));
  }
  return body;
}

}  // namespace impulse
