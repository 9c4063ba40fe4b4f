#pragma once

#include "lib/law/impact_history.hpp"
#include "lib/series/uniform_series.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace impulse {

/// History of one contact that may open and close. Side 1 is the body that arrives (or the earlier one of a chain),
/// side 2 the other; velocities and displacements count in the direction in which side 1 moves.
struct ContactTrace {
  std::vector<double> force_N;             ///< at the samples; 0 where the contact is open
  std::vector<double> running_impulse_Ns;  ///< exact integral of the force that acted
  std::vector<double>
      indentation_m;  ///< approach of the surfaces beyond first touch; minus the gap where the contact is open
  std::vector<double> stored_J;      ///< in the contact, comes back if it opens
  std::vector<double> dissipated_J;  ///< in the contact, so far
  std::vector<bool> in_contact;
  std::vector<double> velocity_1_m_per_s;
  std::vector<double> velocity_2_m_per_s;
  std::vector<double> displacement_1_m;
  std::vector<double> displacement_2_m;
  std::vector<double> work_1_J;  ///< received so far by the body on side 1 through this contact (negative: given up)
  std::vector<double> work_2_J;  ///< received so far by the body on side 2
};

/// Samples without force with the first of which a rigid contact has ended: a wave front that arrives between samples
/// spoils two at most.
inline constexpr std::size_t samples_that_end_a_rigid_contact = 3;

/// Closes the openings of a rigid contact that are shorter than that. Those before its first and after its last sample
/// in contact stay. Verified by: tests/lib/contact_trace.test.cpp
void bridge_wave_fronts(std::vector<bool>& in_contact);

/// One period of contact.
struct ContactInterval {
  double start_s = 0;
  double end_s = 0;  ///< the record's end if the contact is still closed there
  double peak_force_N = 0;
  double peak_time_s = 0;
  double impulse_Ns = 0;
  bool open_ended = false;  ///< still in contact at the end of the record
};

/// The periods of contact of a trace, in order. Ends are interpolated where the force is: a period starts at the linear
/// zero of the indentation before its first sample and ends at the one after its last. Verified by:
/// tests/lib/contact_trace.test.cpp
[[nodiscard]] std::vector<ContactInterval> contact_intervals(const ContactTrace& trace, const UniformGrid& grid);

/// A body that nothing moves but its contacts and its own vibration.
struct FreeBody {
  std::size_t number = 1;    ///< in the row, from 1
  double mass_kg = 0;        ///< > 0
  double speed_m_per_s = 0;  ///< V of its centre of mass at t = 0
  double direction = 1;      ///< of the contact forces on it, in that of V: -1 where it is pushed back
  double preload_N = 0;      ///< P at each contact, which something else balances
};

struct BodyEnergy {
  std::size_t body = 1;
  std::vector<double> translational_J;
};

/// Energy p²/2m of its centre of mass, p = mV ± Σ (∫F dt - P t) over its contacts.
/// @throws std::invalid_argument for a mass that is not positive. Verified by: tests/lib/contact_trace.test.cpp
[[nodiscard]] BodyEnergy translational_energy(const FreeBody& body, const UniformGrid& grid,
                                              std::span<const ContactTrace> contacts);

/// What a summary of contacts needs beyond their traces.
struct ContactsScene {
  double speed_1_m_per_s = 0;
  double speed_2_m_per_s = 0;
  std::optional<double> mass_1_kg = std::nullopt;
  std::optional<double> mass_2_kg = std::nullopt;  ///< of the only other body; none in a row of bodies
  std::size_t contacts_of_body_1 = 1;              ///< the first so many traces are its contacts
  double energy_error = 0;
};

struct ContactsSummary {
  ImpactSummary
      impact;  ///< the largest peak, the duration of the first period, the impulse on body 1 from all its contacts
  std::size_t contact_count = 0;      ///< periods of contact
  std::optional<double> restitution;  ///< J(1/m₁ + 1/m₂)/(V₁ - V₂) - 1, J the impulse; none if a mass is not known
};

/// Verified by: tests/lib/contact_trace.test.cpp
[[nodiscard]] ContactsSummary contacts_summary(const std::vector<ContactTrace>& traces, const UniformGrid& grid,
                                               const ContactsScene& scene);

}  // namespace impulse
