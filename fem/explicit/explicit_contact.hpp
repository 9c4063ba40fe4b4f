#pragma once

#include "fem/explicit/explicit_impact.hpp"
#include "lib/law/contact_law.hpp"
#include "lib/law/contact_trace.hpp"
#include "lib/model/structure.hpp"

#include <cstddef>

namespace impulse {

struct ExplicitContact {
  double speed_m_per_s = 0;    ///< V₁, of every node of the projectile, into the target
  double speed_2_m_per_s = 0;  ///< V₂ < V₁, of every node of the target, away from the projectile if positive
  double step_s = 0;           ///< the target's
  std::size_t projectile_subcycles = 1;  ///< m ≥ 1: the projectile's step is step_s/m
  double duration_s = 0;                 ///< of the record
  double gap_m = 0;                      ///< between the faces at t = 0, ≥ 0
  ContactLaw law = ContactLaw::rigid();
  AfterContact after_contact = AfterContact::go_on;
  Matching matching = Matching::direct;              ///< of a rigid contact
  ImpactStart start = ImpactStart::wave_admittance;  ///< of a rigid contact without a gap
};

struct ExplicitContactResult {
  UniformGrid grid;
  ContactTrace trace;
  BodyBalance projectile;
  BodyBalance target;
  bool in_contact_at_end = false;
  double contact_end_s = 0;  ///< of the last contact: where the force passes zero; the record's end if still in contact
  double energy_error = 0;   ///< when contact has ended for good, or at the record's end
  std::size_t trial_count = 0;
};

/// Two bodies by explicit central differences, as explicit_impact, whose contact has a law and opens and closes. The
/// faces have approached each other by
///
///   α(t) = (V₁ - V₂) t - gap - c₁ᵀd₁ - c₂ᵀd₂
///
/// with the departures d from flight with V₁ and V₂; in the trace α is the indentation.
/// A law that yields: through each step of the target acts the mean force that conserves energy (LawContact); the
/// trace has the law's force at the samples and the running impulse and the works of the mean forces, so that
/// work_1 + work_2 + stored + dissipated = 0 to rounding. The contact is open where α ≤ α0.
/// A rigid contact: as explicit_impact matches velocities from the step at whose end α ≥ 0 while the faces still
/// approach; the force of that sample, F = (v₁ - v₂)/(½Δt Σ cᵀM⁻¹c), exchanges the momentum of the nodes. Contact
/// ends with the third successive sample without compression, or, if the bodies may touch again, with the first one,
/// at the linear zero of the force. What the faces had approached too far when the step ended, less than a step's way,
/// is forgiven: α counts from there and is 0 while they stick. Running impulse and works are trapezoidal sums.
/// Unless they may touch again, bodies whose contact has ended never do.
///
///   energy_error = |(V₁ - V₂) ∫F dt - Σ W - stored - dissipated| / ((V₁ - V₂) ∫F dt)   (W: ExplicitImpactResult)
///
/// Order 2 for a law; a rigid contact that opens or closes inside a step is of order 1. Momentum and running impulse
/// agree to rounding. The step must suit the bodies; a law never makes it unstable, but it is resolved only if the step
/// is short against its duration.
/// A rigid body is a Structure of one degree of freedom without stiffness; its first force on a wave-bearing body, V Z,
/// is known.
/// @throws std::invalid_argument as explicit_impact, and if V₁ ≤ V₂, the gap is negative, a target that moves is held,
/// or a table ends before the contact; ConvergenceError if an iteration misses its tolerance.
/// Verified by: tests/fem/explicit_contact.test.cpp
[[nodiscard]] ExplicitContactResult explicit_contact(const Structure& projectile, const Structure& target,
                                                     const ExplicitContact& contact);

}  // namespace impulse
