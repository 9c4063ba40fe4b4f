#pragma once

#include "impulse/measured/least_squares_kernel.hpp"
#include "lib/transform/real_fft.hpp"

#include <span>
#include <vector>

namespace impulse {

/// A = Σ_b T_bᵀT_b + λ D, D the matrix of the penalty, T_b the N×N lower-triangular Toeplitz matrix of record b's
/// input: see least_squares_kernel.hpp. One for a thread, since it holds the buffers of its transforms.
class NormalEquations {
 public:
  /// λ = regularisation × the largest power of the inputs.
  NormalEquations(std::span<const InputOutput> records, double regularisation, Penalty penalty);

  [[nodiscard]] std::size_t size() const { return size_; }

  /// T_bᵀ r for a record, r = its output (kernel empty) or output - T_b kernel.
  [[nodiscard]] std::vector<double> score(const InputOutput& record, std::span<const double> kernel);

  struct Solution {
    std::vector<double> x;
    std::size_t iterations = 0;
  };
  /// A x = b with ‖b - A x‖ ≤ tolerance ‖b‖ in the preconditioner's norm. @throws ConvergenceError.
  [[nodiscard]] Solution solve(std::span<const double> b, double tolerance, std::size_t most_iterations);

 private:
  void apply(const std::vector<double>& x, std::vector<double>& y);
  void subtract_corner(const std::vector<double>& x, std::vector<double>& y);
  void precondition(const std::vector<double>& x, std::vector<double>& y);
  void factorise();
  void load(std::span<const double> x);

  std::size_t size_;
  std::size_t support_;
  RealFft fft_;
  RealFft corner_fft_;
  std::vector<double> power_;                  ///< Σ|F_b|² + λ·penalty, at the frequencies of fft_
  std::vector<ComplexBuffer> corner_spectra_;  ///< F_b at those of corner_fft_
  ComplexBuffer inverse_factor_;               ///< 1/a
  RealBuffer time_, corner_time_;
  ComplexBuffer spectrum_, input_spectrum_, corner_spectrum_;
};

}  // namespace impulse
