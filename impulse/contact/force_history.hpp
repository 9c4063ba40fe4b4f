#pragma once

#include "lib/transform/causal_convolution.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace impulse {

/// What the contact forces, constant over each step, take back of the approach velocities: with the kernel w_ij (second
/// differences of the displacement U_ij under a unit step force, over Δt; w_ij,0 = U_ij(Δt)/Δt without the jump U(0+)),
///
///   mean velocity over step n at contact i = Σ_j w_ij,0 F_j,n + past_i,   past_i = Σ_j Σ_{k<n} w_ij,n-k F_j,k.
///
/// The steps come one at a time, since each force follows from the past before it.
class ForceHistory {
 public:
  ForceHistory() = default;
  ForceHistory(const ForceHistory&) = delete;
  ForceHistory& operator=(const ForceHistory&) = delete;
  virtual ~ForceHistory() = default;

  [[nodiscard]] virtual std::size_t contact_count() const = 0;
  /// w_ij,0 [m/(N s)].
  [[nodiscard]] virtual double within_step(std::size_t i, std::size_t j) const = 0;
  /// past_i [m/s] for the step after those pushed.
  [[nodiscard]] virtual double past(std::size_t i) const = 0;
  /// Ends the step with the forces [N] of all contacts.
  virtual void push(std::span<const double> forces) = 0;
};

/// Any kernels, by relaxed convolution: O(p² N log² N) in all; kernels that vanish cost nothing.
/// Verified by: tests/impulse/contact_march.test.cpp
class ConvolutionHistory final : public ForceHistory {
 public:
  /// p² kernels of equal length, row i by column j.
  ConvolutionHistory(std::vector<std::vector<double>> weights, std::size_t contact_count);

  [[nodiscard]] std::size_t contact_count() const override { return count_; }
  [[nodiscard]] double within_step(std::size_t i, std::size_t j) const override { return weights_[i * count_ + j][0]; }
  [[nodiscard]] double past(std::size_t i) const override;
  void push(std::span<const double> forces) override;

 private:
  std::size_t count_;
  std::vector<std::vector<double>> weights_;
  std::vector<std::unique_ptr<CausalConvolution>> pairs_;  ///< null where the kernel vanishes
};

}  // namespace impulse
