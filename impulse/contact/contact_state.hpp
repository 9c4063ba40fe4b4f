#pragma once

#include "impulse/contact/contact_march.hpp"

#include <algorithm>

namespace impulse {

/// A law with the bodies' residual flexibility R in series: at the law's indentation a the bodies have approached by a
/// + R F, and the energy taken up is E + R F²/2. A rigid contact with R > 0 is the spring 1/R; where the step does not
/// resolve that spring, because the bodies yield to the force of a step (`own_compliance`) by more than 2R, its mean
/// force is that at the step's end, which settles instead of alternating and loses R(ΔF)²/2 a step.
class SeriesLaw {
 public:
  SeriesLaw(const ContactLaw& law, double residual_flexibility_m_per_N, double own_compliance);

  [[nodiscard]] bool is_rigid() const { return law_.is_rigid(); }
  [[nodiscard]] const ContactLaw& law() const { return law_; }
  [[nodiscard]] double approach(double a, const LawHistory& history) const;
  /// What is left of an approach for the surfaces themselves.
  [[nodiscard]] double surface_indentation(double a) const { return is_residual_ ? std::min(a, 0.0) : a; }
  /// Force over approach, of small changes.
  [[nodiscard]] double stiffness(double a, const LawHistory& history) const;
  /// Mean force over a path from one indentation to another: energy taken up over approach.
  [[nodiscard]] double mean_force(const LawHistory& history, double from, double to) const;

 private:
  ContactLaw law_;
  bool is_residual_;
  bool settles_;
  double residual_;
};

/// State of one contact while it is marched.
class ContactState {
 public:
  /// `own_compliance`: approach that a unit force takes back within the step, Δt w_ii,0 [m/N].
  ContactState(const MarchedContact& given, double own_compliance, std::size_t size);

  /// Mean force over the step in which the bodies would approach to `free` without a force of this contact's own. The
  /// last call before accept counts.
  [[nodiscard]] double force_for(double free);
  void accept(double force, double free);
  void finish_if_open(Recontact recontact);

  /// Whether the force of a law alternates from step to step, because it is stiff against what the bodies yield within
  /// one: with κ = stiffness · own compliance each step multiplies a deviation by (1 - κ/2)/(1 + κ/2), negative beyond
  /// κ = 2. That κ on the loading curve, 0 elsewhere and where the given law is rigid.
  [[nodiscard]] double stiffness_ratio() const;

  [[nodiscard]] double approach() const { return approach_; }
  /// Force of the law at the last sample, and at the end of the step that force_for proposed; 0 of a rigid contact.
  [[nodiscard]] double law_force() const { return result_.force_N.back(); }
  [[nodiscard]] double proposed_law_force() const;
  [[nodiscard]] double preload() const { return given_.preload_N; }
  [[nodiscard]] double free_velocity(std::size_t step) const { return given_.approach_m_per_s[step]; }

  [[nodiscard]] MarchedHistory take();

 private:
  [[nodiscard]] double end_indentation(double free, double opens_at) const;
  void settle_preload();
  [[nodiscard]] bool closed() const;
  void record();

  const MarchedContact& given_;
  SeriesLaw interface_;
  double compliance_;
  double approach_ = 0;
  double indentation_;  ///< of the law
  double proposed_end_ = 0;
  LawHistory history_;
  bool touched_ = false;
  bool finished_ = false;
  double last_force_ = 0;
  double largest_force_ = 0;
  std::size_t open_steps_ = 0;
  MarchedHistory result_;
};

}  // namespace impulse
