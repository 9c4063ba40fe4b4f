#pragma once

#include "lib/law/law_table.hpp"

#include <memory>
#include <utility>

namespace impulse {

/// What a contact remembers between two steps; a new one is a contact never loaded.
struct LawHistory {
  /// What leads from α0 back to αm.
  enum class Path {
    unloading,  ///< αm was reached and the contact has not opened since
    reloading,  ///< the contact has opened since
  };
  double largest_indentation_m = 0;  ///< αm
  double largest_force_N = 0;        ///< Fm, the loading force at αm
  double dissipated_J = 0;           ///< so far
  Path path = Path::unloading;

  friend bool operator==(const LawHistory&, const LawHistory&) = default;
};

/// Contact law of two bodies: the force F in N ≥ 0, in compression, at an indentation α in m (how far the surfaces have
/// approached since they first touched), given what went before. An immutable value, cheap to copy.
///
/// A law consists of a loading curve and of paths between α0(αm) ≥ 0, the permanent indentation, and αm, the largest
/// indentation so far:
///
///   F = 0             for α ≤ α0: the contact is open;
///   F = path(α)       for α0 < α < αm: 0 at α0, Fm at αm; F goes up and down on one and the same path;
///   F = loading(α)    for α ≥ αm.
///
///   law       loading     unloading             reloading    α0
///   linear    k α         loading               loading      0
///   hertz     k α^1.5     loading               loading      0
///   tan_sun   k α^1.5     Fm x^2.5              Fm x^1.5     β(αm - αp) if αm > αp, else 0
///   table     tabulated   tabulated, scaled     unloading    in proportion to αm (LawCurves)
///
/// with x = (α - α0)/(αm - α0), the critical indentation αp in m and β without unit.
///
/// The path is the unloading one from when αm is reached until the contact opens (α ≤ α0 after a step), the reloading
/// one from then until αm is reached again. Partial cycles, of which the Tan-Sun law says nothing, thus retrace: a
/// reload before separation goes back up the unloading curve, and a reload after separation that turns back before αm
/// goes back down the reloading curve. F never jumps. The Tan-Sun law differs from Hertz' even for αm ≤ αp: α0 is 0
/// there, but the exponent of unloading 2.5.
///
/// Energy: what went into the contact is stored + dissipated. Stored is ∫F dα from α0 along the present path, which
/// comes back if the contact opens now; the dissipated energy thus changes at αm only. With the Tan-Sun law
///
///   stored       Fm (αm-α0) x^3.5/3.5 unloading, Fm (αm-α0) x^2.5/2.5 reloading;
///   dissipated   2/5 k αm^2.5 - 2/7 Fm (αm-α0) by loading up to αm for the first time (4/35 k αm^2.5 if αm ≤ αp),
///                4/35 Fm (αm-α0) when a reload after separation arrives at αm,
///
/// both never negative. Of a table the sum of the losses is never negative (LawCurves).
///
/// Limits: rate-independent; a contact that opens and closes within one step isn't seen to have opened.
/// A rigid law has no indentation: nothing is stored or lost, and asking it for a force or tangent is an error.
/// @throws std::invalid_argument, every function that is given an indentation, if it is not finite or beyond the last
/// point of a table.
/// Reference: [Goldsmith1960] (Hertz), [TanSun1985]. Verified by: tests/lib/contact_law.test.cpp
class ContactLaw {
 public:
  [[nodiscard]] static ContactLaw rigid();

  /// @throws std::invalid_argument, all factories, if the stiffness (k > 0; N/m, of the 3/2 laws N/m^1.5) or another
  /// constant is out of range: β in [0, 1), αp ≥ 0 m, a table that LawCurves refuses.
  [[nodiscard]] static ContactLaw linear(double stiffness_N_per_m);
  [[nodiscard]] static ContactLaw hertz(double stiffness_N_per_m32);
  [[nodiscard]] static ContactLaw tan_sun(double stiffness_N_per_m32, double permanent_beta,
                                          double critical_indentation_m);
  [[nodiscard]] static ContactLaw table(LawTable table);

  [[nodiscard]] bool is_rigid() const { return model_ == nullptr; }

  /// The last point of a table; infinity for every other law. Iterations must not try more.
  [[nodiscard]] double largest_possible_indentation_m() const;

  [[nodiscard]] double force(double indentation_m, const LawHistory& history) const;

  /// dF/dα ≥ 0 in N/m, the right derivative at kinks (the left one at the last point of a table).
  [[nodiscard]] double tangent(double indentation_m, const LawHistory& history) const;

  /// Energy in J that comes back if the contact opens from here; 0 for α ≤ α0. For α > αm it is that of the history
  /// advanced to α: the unloading curve from α, not loading's area.
  [[nodiscard]] double stored_energy(double indentation_m, const LawHistory& history) const;

  /// α0 in m.
  [[nodiscard]] double permanent_indentation(const LawHistory& history) const;

  /// The contact separates at indentations up to this one: α0 in m. The gap of the bodies is α0 - α, where positive.
  [[nodiscard]] double gap_closes_at(const LawHistory& history) const { return permanent_indentation(history); }

  /// The history after a step accepted at this indentation, straight from the one before. Idempotent. Along any path
  /// ∫F dα = stored_energy + dissipated_J, to rounding.
  [[nodiscard]] LawHistory advanced(const LawHistory& history, double indentation_m) const;

  class Model;  ///< the curves of one law

 private:
  explicit ContactLaw(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

  std::shared_ptr<const Model> model_;  ///< null: rigid
};

}  // namespace impulse
