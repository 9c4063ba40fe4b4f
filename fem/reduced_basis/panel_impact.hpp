#pragma once

#include "fem/implicit/implicit_impact.hpp"
#include "fem/reduced_basis/reduced_equations.hpp"
#include "fem/shell/shell.hpp"

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace impulse {

/// In what coordinates a panel's motion is sought.
enum class PanelMethod {
  full,    ///< every degree of freedom
  modes,   ///< mode superposition; a nonlinear mesh is evaluated at every force
  ritz,    ///< Wilson's Ritz vectors of the contact force, likewise
  tensor,  ///< Ritz vectors, the nonlinearity by tensors (TensorModel)
};

enum class LeftOut {
  rigid,   ///< what the vectors leave out doesn't move
  static_  ///< it yields by its static flexibility under the contact force
};

struct PanelImpactOptions {
  PanelMethod method = PanelMethod::full;
  Geometry geometry = Geometry::nonlinear;
  std::size_t vectors = 60;            ///< of a reduction
  ModeKind modes = ModeKind::any;      ///< of modes
  std::size_t nonlinear_vectors = 12;  ///< of tensor: the first ones, of finite amplitude; at most 40
  LeftOut left_out = LeftOut::static_;
  std::vector<double> update_s{};  ///< ritz: times, rising, at which Ritz vectors of the present state are added
  double update_tolerance = std::numeric_limits<double>::infinity();  ///< ritz: and whenever unbalanced_force is above
  std::size_t update_vectors = 20;                                    ///< as many each time
};

/// A step in the coordinates it was taken in; after updates of a Ritz basis it means the same.
struct PanelStep {
  Eigen::VectorXd before, after, change_of_velocity;
  double mean_force_N = 0;
};

/// Where the time before the first step went [s].
struct PanelSetUp {
  double factorisation_s = 0;  ///< of the stiffness and, of all degrees of freedom, of a step's matrix
  double vectors_s = 0;        ///< of the basis
  double tensors_s = 0;
};

/// A rigid striker on a panel: the impact, in the coordinates that were chosen, with what the whole panel makes of it.
///
/// An updated Ritz basis keeps the vectors it has and gains those of the tangent stiffness at the time, from the
/// contact force, or from M ψ₁ where nothing touches; the state goes on with 0 for the new coordinates. Updating by
/// tolerance leaves ten steps between two updates. Verified by: tests/fem/panel_impact.test.cpp
class PanelImpact {
 public:
  /// At the first contact of `body`, the structure of the shell. Keeps references to both.
  /// @throws std::invalid_argument as the parts, and for updates out of order or closer than a step.
  PanelImpact(const Shell& shell, const Structure& body, const ContactLaw& law, const ImplicitImpactSetup& setup,
              const PanelImpactOptions& options);

  /// @throws ConvergenceError as ImplicitImpact.
  void advance();

  [[nodiscard]] const ImplicitImpact& impact() const { return *impact_; }
  [[nodiscard]] Eigen::Index unknowns() const { return equations_->size(); }
  [[nodiscard]] std::size_t update_count() const { return updates_; }
  [[nodiscard]] const PanelSetUp& set_up() const { return set_up_; }

  /// Displacement of the whole panel, but for what is left out.
  [[nodiscard]] Eigen::VectorXd displacement() const;

  /// The last one, for unbalanced_force later on: a step by tensors is free of the mesh, its unbalanced force isn't.
  [[nodiscard]] PanelStep last_step() const;

  /// √(rᵀK⁻¹r / 2E), r = F̄c - f̄ - M Δv/Δt in all degrees of freedom through a step, E the energy that arrived: r
  /// would store this share of it, squared, were it let go. Near the tolerance for the full system; large for a basis
  /// under a point force even where its deflections are good, because r then has the whole dimple around the point.
  [[nodiscard]] double unbalanced_force(const PanelStep& step) const;
  [[nodiscard]] double unbalanced_force() const { return unbalanced_force(last_step()); }

  /// The present energy less the one that arrived, relative to it.
  [[nodiscard]] double energy_drift() const;

 private:
  void reduce();
  void update();
  [[nodiscard]] Eigen::VectorXd expand(const Eigen::VectorXd& coordinates) const;
  [[nodiscard]] Eigen::VectorXd whole_force(const Eigen::VectorXd& q) const;

  const Shell& shell_;
  const Structure& body_;
  PanelImpactOptions options_;
  double step_s_;
  double initial_energy_J_ = 0;
  PanelSetUp set_up_;
  std::optional<SparseCholesky> static_factor_;
  std::unique_ptr<ReducedBasis> basis_;
  std::unique_ptr<TensorModel> tensors_;
  std::unique_ptr<MotionEquations> equations_;
  std::unique_ptr<ImplicitImpact> impact_;
  Eigen::VectorXd before_;  // coordinates a step ago
  std::size_t updates_ = 0, steps_since_update_ = 0, next_time_ = 0;
};

}  // namespace impulse
