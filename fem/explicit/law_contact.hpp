#pragma once

#include "fem/explicit/striking_body.hpp"
#include "lib/law/contact_law.hpp"

namespace impulse {

/// Two bodies that press on each other by a contact law. Through a step of the target acts a constant force, the mean
/// that the law's energy E = stored + dissipated asks for at the indentation α at its end:
///
///   F̄ = [E(α) - E(α_begin)]/(α - α_begin),   α = α_free - u F̄
///
/// α_free is the indentation there if no force acts, u what a unit force moves both faces from rest. F̄ and α grow
/// together, so the scalar equation has one solution. Contact is thus integrated implicitly, the bodies explicitly:
/// for a linear law k without subcycles the pair is stable if Δt²K ≤ 4M, whatever k. (With the force f(α) at the end,
/// which is explicit, a spring on a rod at Courant number 1 is unstable however soft it is, for the rod's highest mode
/// is at the limit by itself.) What the bodies lose by F̄ through the step is what E gained, to rounding.
/// Keeps references to the bodies. Verified by: tests/fem/explicit_contact.test.cpp
class LawContact {
 public:
  /// At the indentation `indentation_m` to begin with. @throws std::invalid_argument for a rigid law.
  LawContact(StrikingBody& projectile, StrikingBody& target, const ContactLaw& law, double indentation_m);

  /// Takes both bodies through a step and returns F̄ [N]; `flight_m` is the indentation at its end but for their
  /// departures. @throws std::invalid_argument if the contact is pressed beyond the last point of its law's table.
  double step(double flight_m);

  /// No force from now on.
  void open_for_good() { open_for_good_ = true; }

  [[nodiscard]] bool in_contact() const;
  [[nodiscard]] double indentation_m() const { return indentation_m_; }
  [[nodiscard]] double force_N() const;  ///< the law's at the indentation
  [[nodiscard]] double stored_J() const;
  [[nodiscard]] double dissipated_J() const { return history_.dissipated_J; }

  /// How deep beyond where the contact opens; negative where it is open [m].
  [[nodiscard]] double depth_m() const { return indentation_m_ - law_.permanent_indentation(history_); }

 private:
  [[nodiscard]] double mean_force(double end) const;
  [[nodiscard]] double end_indentation(double free) const;

  StrikingBody& projectile_;
  StrikingBody& target_;
  ContactLaw law_;
  UnitResponse held_1_;
  UnitResponse held_2_;
  double compliance_;  // u [m/N]
  double indentation_m_;
  LawHistory history_;
  double mean_force_ = 0;  // of the last step; it is still in the accelerations
  bool open_for_good_ = false;
};

}  // namespace impulse
