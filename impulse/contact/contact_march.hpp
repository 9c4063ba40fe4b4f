#pragma once

#include "impulse/contact/force_history.hpp"
#include "lib/law/contact_law.hpp"
#include "lib/series/uniform_series.hpp"

#include <cstddef>
#include <vector>

namespace impulse {

enum class Recontact { no, yes };

/// One contact of a march.
struct MarchedContact {
  ContactLaw law = ContactLaw::rigid();
  double residual_flexibility_m_per_N =
      0;             ///< R of both bodies, in series with the law; the whole law of a rigid contact
  double gap_m = 0;  ///< at t = 0
  double preload_N =
      0;  ///< constant force that pressed the bodies together before t = 0, held by what holds the bodies; needs gap 0
  /// Mean over each step of the velocity of approach were there no contact force, V̄_n [m/s], one fewer than samples.
  std::vector<double> approach_m_per_s;
  /// R_ij, what 1 N at contact j moves this one at once; its own entry is not read; empty: nothing.
  std::vector<double> residual_flexibility_across_m_per_N = {};
};

/// What a march finds for one contact.
struct MarchedHistory {
  std::vector<double> mean_force_N;   ///< over each step
  std::vector<double> approach_m;     ///< of the bodies, at the samples: indentation + Σ_j R_ij F_j
  std::vector<double> indentation_m;  ///< of the surfaces, at the samples; minus the gap where open
  std::vector<double> stored_J;       ///< in the law, at the samples
  std::vector<double> residual_J;     ///< in the residual flexibility: F_i Σ_j R_ij F_j/2, the bodies' own
  std::vector<double> dissipated_J;
  std::vector<double> force_N;   ///< at the samples: the law's; of a rigid contact the mean of the neighbouring steps
  std::vector<bool> in_contact;  ///< at the samples; a rigid contact opens with the first of three steps without force
};

/// Contact forces of p contacts with laws, opening and closing, in one march.
///
/// The force of contact i is F̄_i,n over step n; with the history of the forces past (force_history.hpp: w_ij that of
/// the approach which a force at j takes back at i, summed over the bodies that i and j share) the indentations at the
/// samples are exact for that force:
///
///   α_i,n+1 = α_i,n + Δt [V̄_i,n - past_i,n - Σ_j w_ij,0 (F̄_j,n - P_j)]
///
/// and the law holds over each step in the mean that conserves energy: F̄_n = [E(α_n+1) - E(α_n)]/(α_n+1 - α_n), E =
/// stored + dissipated. So the work of the bodies on the contacts is what the laws took up, to the tolerance of the
/// scalar solver, whatever the step. With a residual flexibility R the approach is α + R F and its energy E + R F²/2.
/// Residual flexibility across contacts, R_ij, moves contact i by R_ij times the change of F_j between the samples; its
/// energy R_ij F_i F_j is exact for springs, else of order 2.
/// A rigid contact obeys F̄ ≥ 0, α ≤ 0, F̄ α = 0 at each step's end. Contacts that feel each other within a step (w_ij,0
/// or R_ij ≠ 0) are iterated. Order 2 in Δt for laws; a rigid contact that closes inside a step loses F̄·gap, of
/// order 1. `history` is that of no force; it is left at the record's end. Cost: the history's, and a scalar equation
/// per closed contact and step. `Recontact::no`: a contact that opened (a rigid one: for three steps) stays open.
/// @throws std::invalid_argument for sizes that disagree, w_ii,0 ≤ 0, R_ij² > R_ii R_jj, or a law too stiff for the
/// step (the message has one that is not); ConvergenceError if an iteration does not settle. Verified by:
/// tests/impulse/contact_march.test.cpp
[[nodiscard]] std::vector<MarchedHistory> march_contacts(const UniformGrid& grid,
                                                         const std::vector<MarchedContact>& contacts,
                                                         ForceHistory& history, Recontact recontact);

/// The same with the kernels w_ij, p² of them, convolved.
[[nodiscard]] std::vector<MarchedHistory> march_contacts(const UniformGrid& grid,
                                                         const std::vector<MarchedContact>& contacts,
                                                         const std::vector<std::vector<double>>& weights,
                                                         Recontact recontact);

}  // namespace impulse
