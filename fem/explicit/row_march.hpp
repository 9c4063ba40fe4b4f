#pragma once

#include "fem/explicit/contact_recorder.hpp"
#include "fem/explicit/contact_states.hpp"
#include "fem/explicit/explicit_contacts.hpp"
#include "fem/explicit/force_bisection.hpp"
#include "fem/explicit/joined_bodies.hpp"
#include "fem/explicit/step_forces.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace impulse {

/// A rigid contact that lets go within a step.
struct Release {
  std::size_t contact;
  double part;  ///< of the step, where the force is zero
};

/// Everything that a return to an earlier sample brings back.
struct RowState {
  std::vector<Snapshot> bodies;
  ContactStates contacts;
};

/// Takes the bodies of a row and their contacts from sample to sample and writes down what they do; who lets go and
/// when, and when all is over, is decided outside. The equations are those of explicit_contacts. Keeps references to
/// the bodies and to what was asked.
/// Verified by: tests/fem/explicit_contacts.test.cpp, tests/fem/explicit_rigid_contact.test.cpp
class RowMarch {
 public:
  /// @throws std::invalid_argument as explicit_contacts, but for the bodies.
  RowMarch(const std::vector<ExplicitBody>& flights, const ExplicitContacts& asked, const UniformGrid& grid);

  /// Sample 0: rigid contacts without a gap begin.
  void begin();

  /// From sample n - 1 to n; the contacts of `releases` let go. @throws std::invalid_argument as explicit_contacts.
  void advance(std::size_t n, const std::vector<Release>& releases);

  void keep(RowState& state) const;

  /// The state before the step to sample n, whose forces and those after it are taken out of the record.
  void return_to(const RowState& state, std::size_t n);

  /// |Σ (V₁ - V₂) ∫F dt - Σ W - stored - dissipated| / Σ (V₁ - V₂) ∫F dt, with the bodies as they are, at sample n.
  [[nodiscard]] double energy_error(std::size_t n) const;

  [[nodiscard]] std::size_t trial_count() const { return trial_count_ + (bisection_ ? bisection_->trial_count() : 0); }
  [[nodiscard]] const ContactRecorder& record() const { return recorder_; }
  [[nodiscard]] const std::vector<StrikingBody>& bodies() const { return bodies_.bodies; }

  ContactStates contacts;

 private:
  [[nodiscard]] std::optional<LawContact> law_of(std::size_t i) const;
  [[nodiscard]] double flight_m(std::size_t i, std::size_t n) const;
  [[nodiscard]] StepForces bisect(StepForce shape);
  [[nodiscard]] StepForces match(std::size_t n, const std::vector<std::size_t>& sticking, StepForce shape,
                                 const std::vector<Release>& releases);
  void close(std::size_t n, const std::vector<Release>& releases);
  void meet(std::size_t n, const std::vector<std::size_t>& closing);
  void record_law(std::size_t i, std::size_t n, const LawContact::Answer& answer);
  void record_sticking(std::size_t i, std::size_t n, StepForce shape, double more_N);
  void record_open(std::size_t i, std::size_t n, const std::vector<Release>& releases);

  const std::vector<ExplicitBody>& flights_;
  const ExplicitContacts& asked_;
  UniformGrid grid_;
  JoinedBodies bodies_;
  ContactRecorder recorder_;
  std::optional<ForceBisection> bisection_;
  double speed_scale_ = 0;
  std::size_t trial_count_ = 0;
};

}  // namespace impulse
