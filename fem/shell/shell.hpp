#pragma once

#include "fem/implicit/equilibrium_path.hpp"
#include "fem/shell/shell_geometry.hpp"
#include "fem/shell/shell_panel.hpp"
#include "fem/shell/shell_supports.hpp"
#include "lib/model/structure.hpp"

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <functional>
#include <memory>
#include <vector>

namespace impulse {

/// Energy of a displacement and its derivative, the internal force.
struct ShellForce {
  double energy_J = 0;
  Eigen::VectorXd force;
};

/// A place on a panel: arc lengths from the corner of edges 4 and 1 [m].
struct PanelPoint {
  double x_m = 0;
  double y_m = 0;
};

/// Strain of the mid-surface (εx, εy, γxy) and change of curvature (κx, κy, κxy) in 1/m, along e1, which is x, and
/// e2 = n × e1: the strain at height z is ε + zκ.
struct ShellStrain {
  Eigen::Vector3d membrane;
  Eigen::Vector3d curvature;
};

/// Thin laminated shell of four-node elements with 48 degrees of freedom: bicubic Hermite interpolation of each
/// Cartesian displacement component and of the stress-free surface, Kirchhoff-Love,
///
///   E(u) = ½∫ (ε·Aε + 2ε·Bκ + κ·Dκ) dA,   ε_αβ = ½ (a_α·u_,β + a_β·u_,α + u_,α·u_,β),   κ_αβ = -(u_,αβ - Γ^λ_αβ
///   u_,λ)·n
///
/// by 4 × 4 Gauss points: moderate rotations, of which the membrane strains know all and the curvatures the linear
/// part. E is a quartic polynomial. Degrees of freedom are those that the supports leave; z below is a vector of them.
/// Limits: no transverse shear. Under a point force the deflection converges; curvature there is singular.
/// Reference: [KapaniaYang1986]. Verified by: tests/fem/shell.test.cpp, tests/fem/shell_published.test.cpp
class Shell {
 public:
  /// @throws std::invalid_argument as require_valid(ShellPanel), and if the supports leave nothing to move.
  explicit Shell(const ShellPanel& panel);

  [[nodiscard]] Eigen::Index size() const { return unrestrained_.cols(); }
  [[nodiscard]] const ShellPanel& panel() const { return panel_; }

  /// Cost: 10 µs to 35 µs for 8 × 8 elements, by the processor's vector registers.
  [[nodiscard]] ShellForce internal(const Eigen::VectorXd& z) const;

  /// ∂²E/∂z², both triangles, one sparsity pattern for every z; at z = 0 the stiffness.
  [[nodiscard]] Eigen::SparseMatrix<double> tangent(const Eigen::VectorXd& z) const;

  /// ∫ I₀ δu·u dA: consistent, without rotary inertia.
  [[nodiscard]] Eigen::SparseMatrix<double> mass() const;

  /// c with cᵀz = direction · u at the point. @throws std::invalid_argument for a point outside the panel.
  [[nodiscard]] Eigen::VectorXd displacement_functional(const PanelPoint& point,
                                                        const Eigen::Vector3d& direction) const;

  /// Normal of the stress-free surface; z in the middle of a panel.
  [[nodiscard]] Eigen::Vector3d normal(const PanelPoint& point) const;

  /// Place of the stress-free surface in space.
  [[nodiscard]] Eigen::Vector3d place(const PanelPoint& point) const;

  [[nodiscard]] Eigen::Vector3d displacement(const Eigen::VectorXd& z, const PanelPoint& point) const;

  [[nodiscard]] ShellStrain strain(const Eigen::VectorXd& z, const PanelPoint& point) const;

  /// Its part linear in z, (ε(z) - ε(-z))/2: what the theory of small displacements calls the strain.
  [[nodiscard]] ShellStrain small_strain(const Eigen::VectorXd& z, const PanelPoint& point) const;

  /// Of the stress-free surface.
  [[nodiscard]] double area_m2() const;

  /// Nodal forces of a force per stress-free area that keeps its direction [N/m²].
  [[nodiscard]] Eigen::VectorXd uniform_load(const Eigen::Vector3d& traction) const;

  /// Nodal values of the unrestrained panel (order in shell_geometry.hpp), and the z that is nearest to such values.
  [[nodiscard]] Eigen::VectorXd nodal_values(const Eigen::VectorXd& z) const;
  [[nodiscard]] Eigen::VectorXd restrained(const Eigen::VectorXd& values) const;

  [[nodiscard]] const std::vector<ShellElement>& elements() const { return elements_; }

 private:
  struct Site;
  struct AlignedFree {
    void operator()(double* memory) const;
  };

  void pack_geometry();
  void make_pattern();
  [[nodiscard]] Site site(const PanelPoint& point) const;
  [[nodiscard]] Eigen::MatrixXd element_basis(const ShellElement& element) const;
  [[nodiscard]] Eigen::SparseMatrix<double> assembled(
      const std::function<void(std::size_t, Eigen::Matrix<double, 48, 48>&)>& element_matrix) const;

  ShellPanel panel_;
  std::vector<ShellElement> elements_;
  std::vector<SupportedNode> nodes_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> unrestrained_;  ///< nodal values from z; a zero row past the last
  Eigen::SparseMatrix<double, Eigen::RowMajor> restrained_;    ///< its transpose
  std::vector<ShellPoint> points_;                             ///< 16 per element
  std::vector<Matrix6d> rigidity_;                             ///< C of the kernel at each of them
  std::unique_ptr<double[], AlignedFree> packed_;              ///< what the kernel reads, batch after batch
  std::vector<int> gather_dof_;                                ///< per batch [coefficient][lane]
  std::vector<double> gather_scale_;
  Eigen::SparseMatrix<double> pattern_;
  std::vector<int> position_;  ///< of each element's entries in the pattern's values
  std::vector<std::size_t> position_start_;
};

/// The shell for statics; lengths are root mean square displacements. Keeps a reference to it.
[[nodiscard]] ElasticBody elastic_body(const Shell& shell);

/// K at rest, M, and a contact and output for each point: the displacement along the surface's normal there; of a panel
/// that nothing holds also the translation along the first.
/// @throws std::invalid_argument for a point outside the panel or held by a support.
/// Verified by: tests/fem/shell.test.cpp
[[nodiscard]] Structure shell_structure(const Shell& shell, const std::vector<PanelPoint>& contacts);

}  // namespace impulse
