#pragma once

#include "fem/explicit/explicit_bodies.hpp"
#include "fem/explicit/explicit_impact.hpp"
#include "lib/law/contact_law.hpp"
#include "lib/law/contact_trace.hpp"

#include <cstddef>
#include <vector>

namespace impulse {

struct ExplicitContacts {
  double step_s = 0;
  double duration_s = 0;         ///< of the record
  std::vector<ContactLaw> laws;  ///< of each contact
  std::vector<double> gaps_m;    ///< of each contact at t = 0, ≥ 0
  AfterContact after_contact = AfterContact::go_on;
  Matching matching = Matching::direct;  ///< bisection: for one rigid contact
  ImpactStart start = ImpactStart::wave_admittance;
};

struct ExplicitContactsResult {
  UniformGrid grid;
  std::vector<ContactTrace> traces;   ///< one a contact
  std::vector<BodyBalance> balances;  ///< one a body
  bool in_contact_at_end = false;
  double contact_end_s = 0;  ///< of the last contact: where the force passes zero; the record's end if still in contact
  double energy_error = 0;   ///< when all contacts have ended for good, or at the record's end
  std::size_t trial_count = 0;
};

/// A row of bodies, or two that meet at several points (`row_joints`), by explicit central differences; each contact
/// has its law, its gap, and opens and closes for itself. At contact i the faces have approached each other by
///
///   α_i(t) = (V₁ - V₂) t - gap_i - c₁ᵀd₁ - c₂ᵀd₂ - Σ_j R_ij F_j
///
/// with the departures d of its two bodies from flight with V₁ and V₂; in the traces α is the indentation.
/// A law that yields: through each step acts the mean force that conserves energy (LawContact); the trace has the law's
/// force at the samples and the running impulse and the works of the mean forces, so that work_1 + work_2 + stored +
/// dissipated = 0 to rounding but for the residual flexibility, whose energy the bodies hold. Open where α ≤ α0.
/// A rigid contact: as explicit_impact matches velocities from the step at whose end α ≥ 0 while the faces still
/// approach; the force that begins there (meeting_forces) exchanges the momentum of the faces' masses, on all contacts
/// that stick at once, and while they stick the bodies move as one mesh does: on a given mesh force and impulse then
/// have order 2. The record shows it as explicit_impact says; a touch of one step exchanges no more than that. Contact
/// ends with the third successive sample without compression, at the linear zero of the force; all bodies then return
/// to its last sample in compression. Bodies that may touch again part with the first such sample, since a wave front
/// that brings the force back finds them there; in the record that is one contact if they meet again before the third.
/// What the faces had approached too far when the step ended, less than a step's way, is forgiven: α counts from there
/// and is 0 while they stick. Running impulse and works are trapezoidal sums. Faces that touch at t = 0 without
/// approaching each other wait until they do. A rigid contact whose bodies have a residual flexibility R there is the
/// spring 1/R; of any other law R lies in series. Unless they may touch again, a contact that has ended never closes
/// again.
///
///   energy_error = |Σ (V₁ - V₂) ∫F dt - Σ W - stored - dissipated| / Σ (V₁ - V₂) ∫F dt   (W: ExplicitImpactResult)
///
/// Order 2 for laws. A rigid contact that opens or closes inside a step is of order 1, in time by up to a step, because
/// the faces' lumped masses meet as one on a sample; a stiff linear law has order 2 (docs/decisions/0007).
/// Momentum and running impulse agree to rounding. The step must suit the bodies; a law never makes it unstable, but
/// must be resolved (require_resolved_law).
/// @throws std::invalid_argument if bodies, contacts, laws and gaps do not fit each other (require_valid), no contact
/// closes, a gap is negative, a law is too stiff for the step, or a table ends before the contact; ConvergenceError if
/// an iteration misses its tolerance. Verified by: tests/fem/explicit_contacts.test.cpp, explicit_contact.test.cpp,
/// explicit_rigid_contact.test.cpp, explicit_law_contact.test.cpp, tests/cross/contacts.test.cpp
[[nodiscard]] ExplicitContactsResult explicit_contacts(const std::vector<ExplicitBody>& bodies,
                                                       const ExplicitContacts& contacts);

}  // namespace impulse
