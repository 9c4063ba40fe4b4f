#pragma once

#include "lib/law/contact_law.hpp"

namespace impulse {

/// A contact law in an explicit computation, with the residual flexibility R of the bodies in series. Through a step
/// acts a constant force, the mean that the energy E = stored + dissipated + ½Rf² asks for, with the law's force f at
/// the indentation α at the step's end:
///
///   F̄ = [E(α) - E(α_begin)]/(a - a_begin),   a = α + R f(α) = a_free - u F̄
///
/// a is the approach, a_free that at the step's end if no force acts, u what a unit force moves both faces from rest. F̄
/// and α grow together, so the scalar equation has one solution. Contact is thus integrated implicitly, the bodies
/// explicitly: for a linear law k without subcycles the pair is stable if Δt²K ≤ 4M, whatever k. (With the force f(α)
/// at the end, which is explicit, a spring on a rod at Courant number 1 is unstable however soft it is, for the rod's
/// highest mode is at the limit by itself.) What the bodies lose by F̄ through the step is what E gained, to rounding.
/// Verified by: tests/fem/explicit_law_contact.test.cpp
class LawContact {
 public:
  /// At the indentation `indentation_m` to begin with. @throws std::invalid_argument for a rigid law.
  LawContact(const ContactLaw& law, double residual_flexibility_m_per_N, double indentation_m);

  struct Answer {
    double indentation_m = 0;
    double mean_force_N = 0;
    double force_N = 0;  ///< the law's at the end
  };

  /// Of a step with this a_free and u. @throws std::invalid_argument if the contact is pressed beyond the last point of
  /// its law's table.
  [[nodiscard]] Answer answer(double free_approach_m, double compliance_m_per_N) const;

  /// The step is over.
  void accept(const Answer& answer);

  /// No force from now on.
  void open_for_good() { open_for_good_ = true; }

  [[nodiscard]] bool over() const { return open_for_good_; }
  [[nodiscard]] bool in_contact() const { return !open_for_good_ && depth_m() > 0; }
  [[nodiscard]] double indentation_m() const { return indentation_m_; }
  [[nodiscard]] double force_N() const;  ///< the law's at the indentation
  [[nodiscard]] double mean_force_N() const { return mean_force_; }
  [[nodiscard]] double stored_J() const;  ///< in the law
  [[nodiscard]] double dissipated_J() const { return history_.dissipated_J; }
  [[nodiscard]] double residual_J() const { return 0.5 * residual_ * force_N() * force_N(); }

  /// κ of require_resolved_law on the loading curve, R in series, for the approach `compliance` that a unit force takes
  /// back within a step; 0 elsewhere.
  [[nodiscard]] double stiffness_ratio(double compliance_m_per_N) const;

  /// How deep beyond where the contact opens; negative where it is open [m].
  [[nodiscard]] double depth_m() const { return indentation_m_ - law_.permanent_indentation(history_); }

 private:
  [[nodiscard]] double approach(double indentation) const;
  [[nodiscard]] double mean_force(double end) const;
  [[nodiscard]] double end_indentation(double free, double compliance) const;

  ContactLaw law_;
  double residual_;  // R [m/N]
  double indentation_m_;
  LawHistory history_;
  double mean_force_ = 0;  // of the last step; it is still in the accelerations
  bool open_for_good_ = false;
};

}  // namespace impulse
