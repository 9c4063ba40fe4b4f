#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace impulse {

/// One experiment on a linear, causal system at rest: samples of what went in and of what came out.
struct InputOutput {
  std::vector<double> input;
  std::vector<double> output;
};

/// @throws std::invalid_argument for no record, or records without or of unequal samples.
void require_alike(std::span<const InputOutput> records);

/// Σ_j weight_j x_j = value, imposed on an estimated kernel.
struct LinearConstraint {
  std::vector<double> weight;
  double value = 0;
};

/// What of the kernel λ holds down.
enum class Penalty {
  size,   ///< Σ x_j²
  slope,  ///< Σ (x_j - x_(j-1))², x zero before and after: for kernels that are smooth, as forces are
};

/// |1 - e^(-iω)|² or 1 at frequency k of a transform.
[[nodiscard]] double penalty_at(Penalty penalty, std::size_t k, std::size_t transform_size);

/// Whether an estimate's deviations are wanted beside it.
enum class Deviations { none, closed_form };

struct KernelOptions {
  double regularisation = 0;  ///< λ over the largest power of the inputs, > 0
  Penalty penalty = Penalty::size;
  const LinearConstraint* constraint = nullptr;
  Deviations deviations = Deviations::closed_form;
  double tolerance = 1e-6;  ///< of the normal equations' residual, relative, > 0; what is left is at the record's end
  std::size_t most_iterations = 2000;
};

struct EstimatedKernel {
  std::vector<double> values;                   ///< x
  std::vector<std::vector<double>> deviations;  ///< one per record; the covariance of x is their Σ d dᵀ
  std::size_t degrees_of_freedom = 0;           ///< of that covariance: records - 1; no deviations if 0
  std::size_t iterations = 0;                   ///< of conjugate gradients, for x
};

/// The causal kernel x_0 .. x_(N-1) that explains all records best: with (f_b, v_b) record b of N samples,
///
///   minimise  Σ_b Σ_n (v_b,n - Σ_(j≤n) x_j f_b,n-j)² + λ · penalty(x),
///
/// λ = regularisation · max_ω Σ_b |F_b(ω)|². Nothing is assumed about either signal outside its record.
/// The normal equations (Σ_b T_bᵀT_b + λ) x = Σ_b T_bᵀv_b are Toeplitz but for a corner as wide as the inputs' support
/// P (their last non-zero sample), and are solved by conjugate gradients, preconditioned with
/// T_aᵀT_a, a the minimum-phase factor of Σ|F|² + λ, which is exact but for the corner; their solution is that of the
/// dense problem to `tolerance`.
/// The deviations, if wanted, are those of the bootstrap over records, linearised and in closed form
/// (docs/decisions/0014): d_b = √(B/(B-1)) A⁻¹ (s_b - s̄), s_b = T_bᵀ(v_b - T_b x) the score of a record, to 1 % of
/// their norm. A constraint moves x and each d_b along A⁻¹a, the best way to meet it. Cost: 6 real transforms of length
/// 2N and 4 B of length 2P an iteration; of these 5 to 50, more the smaller λ.
/// @throws std::invalid_argument for no record, unequal or no samples, inputs all zero or λ ≤ 0; ConvergenceError.
/// Verified by: tests/impulse/least_squares_kernel.test.cpp
[[nodiscard]] EstimatedKernel least_squares_kernel(std::span<const InputOutput> records, const KernelOptions& options);

/// The kernel without regularisation, for records without noise: the sum of the outputs divided by the sum of the
/// inputs as power series, exactly; leading samples where all inputs are zero are passed over, and the kernel is that
/// much shorter. Deviations: those of the same linearised bootstrap.
/// @throws std::invalid_argument as above; ConvergenceError if the division loses more than 1e-6 of the outputs, which
/// it does where an input begins much more gently than it goes on. Verified by:
/// tests/impulse/least_squares_kernel.test.cpp
[[nodiscard]] EstimatedKernel divided_kernel(std::span<const InputOutput> records);

}  // namespace impulse
