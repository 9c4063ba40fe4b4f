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

/// The one contact of two bodies: explicit_contacts, whose equations, order and exceptions hold here, of the projectile
/// and the target. A rigid body is a Structure of one degree of freedom without stiffness; its first force on a
/// wave-bearing body, V Z, is known.
/// @throws std::invalid_argument as explicit_contacts, and if V₁ ≤ V₂ or a body has several contacts.
/// Verified by: tests/fem/explicit_contact.test.cpp, tests/fem/explicit_law_contact.test.cpp
[[nodiscard]] ExplicitContactResult explicit_contact(const Structure& projectile, const Structure& target,
                                                     const ExplicitContact& contact);

}  // namespace impulse
