#pragma once

#include "fem/explicit/explicit_impact.hpp"
#include "fem/explicit/joined_bodies.hpp"
#include "lib/law/contact_trace.hpp"

#include <cstddef>
#include <vector>

namespace impulse {

/// Writes down sample by sample what the contacts of a row do.
class ContactRecorder {
 public:
  ContactRecorder(const JoinedBodies& bodies, const std::vector<ExplicitBody>& flights, const UniformGrid& grid);

  /// Velocities and displacements of the faces at sample n, with the residual flexibility under these forces.
  void motion(std::size_t n, const Eigen::VectorXd& law_forces);

  /// Turns the velocities at sample n into right limits of jumps (first_velocities).
  void jump(std::size_t n, const Eigen::MatrixX2d& velocities);

  /// The step to sample n of a rigid contact with a force that goes from begin to end.
  void rigid_step(std::size_t contact, std::size_t n, double begin_N, double end_N);

  /// The step to sample n in which the force fell from begin to zero at the fraction `part`.
  void release_step(std::size_t contact, std::size_t n, double begin_N, double part);

  /// The step to sample n of a law.
  void law_step(std::size_t contact, std::size_t n, double mean_force);

  /// Σ (V₁ - V₂) ∫F dt up to sample n [J].
  [[nodiscard]] double offered_J(std::size_t n) const;

  /// The traces up to `size` samples.
  [[nodiscard]] std::vector<ContactTrace> traces(std::size_t size) const;

  std::vector<ContactTrace> now;  ///< one a contact, as long as the grid

 private:
  const JoinedBodies& bodies_;
  const std::vector<ExplicitBody>& flights_;
  UniformGrid grid_;
};

/// Of body `index`, whose departure comes on top of its flight.
[[nodiscard]] BodyBalance balance(const StrikingBody& body, const ExplicitBody& flight, std::size_t index);

}  // namespace impulse
