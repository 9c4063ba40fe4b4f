#pragma once

#include "impulse/contact/force_history.hpp"
#include "lib/model/modal_model.hpp"

#include <vector>

namespace impulse {

/// History of one body given by its modes, each advanced exactly for a force constant over the step: the kernel of a
/// mode is a damped rotation,
///
///   w_ij,k = φᵢφⱼ Re[κ λ^(k-1)], k ≥ 1,   λ = e^((-ζω + iω_d)Δt),   κ = -(1 - iζω/ω_d)(λ - 1)²/(ω²Δt)
///
/// so that past_i = Σ φᵢ Re z with one complex number z per mode, z ← λz + κ Σ_j φⱼF_j. A rigid-body mode is the limit
/// λ = 1, κ = Δt. The residual flexibility is not part of it: it lies in series with the contact law.
/// The same as convolution with the second differences of modal_response, to rounding, which grows as N ε.
/// Cost: O(N·modes) in all, no memory that grows with N. Verified by: tests/impulse/modal_history.test.cpp
class ModalHistory final : public ForceHistory {
 public:
  /// @throws std::invalid_argument for an invalid model or step.
  ModalHistory(const ModalModel& body, double step_s);

  [[nodiscard]] std::size_t contact_count() const override { return count_; }
  [[nodiscard]] double within_step(std::size_t i, std::size_t j) const override { return within_[i * count_ + j]; }
  [[nodiscard]] double past(std::size_t i) const override { return past_[i]; }
  void push(std::span<const double> forces) override;

 private:
  struct Rotations {                       ///< one entry a mode, padded to whole vectors with modes that do nothing
    std::vector<double> turn_c, turn_s;    ///< λ
    std::vector<double> drive_c, drive_s;  ///< κ; of a single contact times φ²
    std::vector<double> x, y;              ///< z
  };
  void set_mode(const ModalModel& body, Eigen::Index mode, double step_s);
  void forget_what_has_decayed();

  std::size_t count_;
  Rotations modes_;
  std::vector<std::vector<double>> participation_;  ///< contact by mode, where there are several contacts
  std::vector<double> modal_force_;
  std::vector<double> within_;
  std::vector<double> past_;
  std::size_t steps_ = 0;
};

}  // namespace impulse
