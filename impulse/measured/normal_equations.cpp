#include "impulse/measured/normal_equations.hpp"

#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/transform/spectrum_product.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

namespace impulse {
namespace {

std::size_t support(std::span<const InputOutput> records) {
  std::size_t longest = 0;
  for (const InputOutput& record : records) {
    const auto last = std::find_if(record.input.rbegin(), record.input.rend(), [](double x) { return x != 0; });
    longest = std::max(longest, static_cast<std::size_t>(record.input.rend() - last));
  }
  require(longest > 0, "the inputs are zero throughout, so they say nothing about the outputs");
  return longest;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

NormalEquations::NormalEquations(std::span<const InputOutput> records, double regularisation, Penalty penalty)
    : size_(records.front().input.size()),
      support_(support(records)),
      fft_(fast_transform_size(2 * size_)),
      corner_fft_(fast_transform_size(2 * support_)),
      power_(fft_.spectrum_size()),
      time_(fft_.size()),
      corner_time_(corner_fft_.size()),
      spectrum_(fft_.spectrum_size()),
      input_spectrum_(fft_.spectrum_size()),
      corner_spectrum_(corner_fft_.spectrum_size()) {
  for (const InputOutput& record : records) {
    load(record.input);
    fft_.forward(time_, input_spectrum_);
    for (std::size_t k = 0; k < power_.size(); ++k) power_[k] += std::norm(input_spectrum_[k]);
    std::ranges::fill(corner_time_, 0.0);
    std::copy_n(record.input.begin(), support_, corner_time_.begin());
    corner_spectra_.emplace_back(corner_fft_.spectrum_size());
    corner_fft_.forward(corner_time_, corner_spectra_.back());
  }
  const double lambda = regularisation * *std::ranges::max_element(power_);
  for (std::size_t k = 0; k < power_.size(); ++k) power_[k] += lambda * penalty_at(penalty, k, fft_.size());
  factorise();
}

void NormalEquations::load(std::span<const double> x) {
  std::ranges::copy(x, time_.begin());
  std::fill(time_.begin() + static_cast<std::ptrdiff_t>(x.size()), time_.end(), 0.0);
}

std::vector<double> NormalEquations::score(const InputOutput& record, std::span<const double> kernel) {
  load(record.input);
  fft_.forward(time_, input_spectrum_);
  std::vector<double> rest = record.output;
  if (!kernel.empty()) {
    load(kernel);
    fft_.forward(time_, spectrum_);
    multiply(spectrum_, input_spectrum_);
    fft_.inverse(spectrum_, time_);
    for (std::size_t n = 0; n < size_; ++n) rest[n] -= time_[n];
  }
  load(rest);
  fft_.forward(time_, spectrum_);
  multiply_conjugate(spectrum_, input_spectrum_);
  fft_.inverse(spectrum_, time_);
  rest.assign(time_.begin(), time_.begin() + static_cast<std::ptrdiff_t>(size_));
  return rest;
}

void NormalEquations::apply(const std::vector<double>& x, std::vector<double>& y) {
  load(x);
  fft_.forward(time_, spectrum_);
  for (std::size_t k = 0; k < spectrum_.size(); ++k) spectrum_[k] *= power_[k];
  fft_.inverse(spectrum_, time_);
  for (std::size_t n = 0; n < size_; ++n) y[n] = time_[n];
  subtract_corner(x, y);
}

// What the Toeplitz matrix of the inputs' autocorrelation counts too much: the outputs after the record's end.
void NormalEquations::subtract_corner(const std::vector<double>& x, std::vector<double>& y) {
  const std::size_t width = support_ - 1;
  const std::size_t first = size_ - width;
  for (const ComplexBuffer& input : corner_spectra_) {
    std::ranges::fill(corner_time_, 0.0);
    std::copy(x.begin() + static_cast<std::ptrdiff_t>(first), x.end(), corner_time_.begin());
    corner_fft_.forward(corner_time_, corner_spectrum_);
    multiply(corner_spectrum_, input);
    corner_fft_.inverse(corner_spectrum_, corner_time_);
    std::fill_n(corner_time_.begin(), width, 0.0);
    corner_fft_.forward(corner_time_, corner_spectrum_);
    multiply_conjugate(corner_spectrum_, input);
    corner_fft_.inverse(corner_spectrum_, corner_time_);
    for (std::size_t n = 0; n < width; ++n) y[first + n] -= corner_time_[n];
  }
}

// With a the minimum-phase factor, |a|² = Σ|F|² + λ·penalty, T_aᵀT_a is A but for the end corner: its inverse is a
// convolution with 1/a after a correlation with it.
void NormalEquations::precondition(const std::vector<double>& x, std::vector<double>& y) {
  load(x);
  fft_.forward(time_, spectrum_);
  multiply_conjugate(spectrum_, inverse_factor_);
  fft_.inverse(spectrum_, time_);
  std::fill(time_.begin() + static_cast<std::ptrdiff_t>(size_), time_.end(), 0.0);
  fft_.forward(time_, spectrum_);
  multiply(spectrum_, inverse_factor_);
  fft_.inverse(spectrum_, time_);
  std::copy_n(time_.begin(), size_, y.begin());
}

// log a is the causal half of log |a|² (Kolmogorov): its transform's positive times, half of time 0.
void NormalEquations::factorise() {
  for (std::size_t k = 0; k < power_.size(); ++k) spectrum_[k] = std::log(power_[k]);
  fft_.inverse(spectrum_, time_);
  const std::size_t half = fft_.size() / 2;
  time_[0] /= 2;
  time_[half] /= 2;
  std::fill(time_.begin() + static_cast<std::ptrdiff_t>(half) + 1, time_.end(), 0.0);
  fft_.forward(time_, spectrum_);
  inverse_factor_.resize(spectrum_.size());
  for (std::size_t k = 0; k < spectrum_.size(); ++k) inverse_factor_[k] = std::exp(-spectrum_[k]);
}

NormalEquations::Solution NormalEquations::solve(std::span<const double> b, double tolerance,
                                                 std::size_t most_iterations) {
  Solution solution{std::vector<double>(size_), 0};
  std::vector<double> residual(b.begin(), b.end());
  std::vector<double> preconditioned(size_);
  std::vector<double> image(size_);
  precondition(residual, preconditioned);
  std::vector<double> direction = preconditioned;
  double rho = dot(residual, preconditioned);
  const double wanted = tolerance * tolerance * rho;
  while (rho > wanted) {
    if (solution.iterations == most_iterations)
      throw ConvergenceError(
          fmt::format("the deconvolution's normal equations are solved to {:.2g} only after {} iterations; use a "
                      "larger --regularisation",
                      tolerance * std::sqrt(rho / wanted), most_iterations),
          tolerance, tolerance * std::sqrt(rho / wanted), most_iterations);
    ++solution.iterations;
    apply(direction, image);
    const double step = rho / dot(direction, image);
    for (std::size_t n = 0; n < size_; ++n) {
      solution.x[n] += step * direction[n];
      residual[n] -= step * image[n];
    }
    precondition(residual, preconditioned);
    const double before = std::exchange(rho, dot(residual, preconditioned));
    for (std::size_t n = 0; n < size_; ++n) direction[n] = preconditioned[n] + rho / before * direction[n];
  }
  return solution;
}

}  // namespace impulse
