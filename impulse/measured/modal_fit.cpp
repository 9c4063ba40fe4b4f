#include "impulse/measured/modal_fit.hpp"

#include "lib/contract/require.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <complex>

namespace impulse {
namespace {

using Complex = std::complex<double>;

/// Samples of one mode of unit amplitude.
Eigen::VectorXd unit_mode(double frequency, double decay, const BandFilter& filter, double step_s, Eigen::Index size) {
  const double square = frequency * frequency + decay * decay;
  const Complex z = std::exp(Complex(-decay, frequency) * step_s);
  const auto first = static_cast<double>(1 + filter.first());
  Complex term = -Complex(1, -decay / frequency) * (z - 2.0 + 1.0 / z) / (square * step_s * step_s) * filter.gain(z) *
                 std::exp(Complex(-decay, frequency) * (step_s * first));
  const Complex turn = std::exp(Complex(-decay, frequency) * (step_s * static_cast<double>(filter.decimation())));
  Eigen::VectorXd samples(size);
  for (Eigen::Index j = 0; j < size; ++j) {
    samples(j) = term.real();
    term *= turn;
  }
  return samples;
}

class Problem {
 public:
  Problem(const std::vector<double>& filtered, const BandFilter& filter, double step_s, RigidTerm rigid)
      : data_(Eigen::Map<const Eigen::VectorXd>(filtered.data(), static_cast<Eigen::Index>(filtered.size()))),
        filter_(filter),
        step_s_(step_s),
        rigid_(rigid == RigidTerm::fitted ? 1 : 0) {}

  /// Amplitudes best for the poles as they are; returns the residual.
  Eigen::VectorXd fit_amplitudes(ModalFit& fit) const {
    const Eigen::MatrixXd shapes = amplitudes_basis(fit);
    const Eigen::VectorXd amplitude = shapes.colPivHouseholderQr().solve(data_);
    if (rigid_ == 1) fit.rigid = amplitude(0);
    for (std::size_t m = 0; m < fit.modes.size(); ++m)
      fit.modes[m].amplitude = amplitude(rigid_ + static_cast<Eigen::Index>(m));
    const Eigen::VectorXd residual = data_ - shapes * amplitude;
    fit.residual_norm = residual.norm();
    return residual;
  }

  /// Derivatives of the model by amplitude (and rigid), frequency and decay of all modes, columns in that order.
  [[nodiscard]] Eigen::MatrixXd jacobian(const ModalFit& fit) const {
    const auto count = static_cast<Eigen::Index>(fit.modes.size());
    Eigen::MatrixXd result(data_.size(), rigid_ + 3 * count);
    result.leftCols(rigid_ + count) = amplitudes_basis(fit);
    for (Eigen::Index m = 0; m < count; ++m) {
      const FittedMode& mode = fit.modes[static_cast<std::size_t>(m)];
      const double h = 1e-5 * mode.frequency;
      result.col(rigid_ + count + m) = slope(mode, h, 0);
      result.col(rigid_ + 2 * count + m) = slope(mode, 0, std::min(h, 0.5 * mode.decay));
    }
    return result;
  }

  [[nodiscard]] Eigen::Index rigid_count() const { return rigid_; }
  [[nodiscard]] Eigen::Index size() const { return data_.size(); }
  [[nodiscard]] double norm() const { return data_.norm(); }

 private:
  [[nodiscard]] Eigen::MatrixXd amplitudes_basis(const ModalFit& fit) const {
    Eigen::MatrixXd shapes(data_.size(), rigid_ + static_cast<Eigen::Index>(fit.modes.size()));
    if (rigid_ == 1) shapes.col(0).setOnes();
    for (std::size_t m = 0; m < fit.modes.size(); ++m)
      shapes.col(rigid_ + static_cast<Eigen::Index>(m)) =
          unit_mode(fit.modes[m].frequency, fit.modes[m].decay, filter_, step_s_, data_.size());
    return shapes;
  }
  [[nodiscard]] Eigen::VectorXd slope(const FittedMode& mode, double frequency, double decay) const {
    const Eigen::VectorXd after =
        unit_mode(mode.frequency + frequency, mode.decay + decay, filter_, step_s_, data_.size());
    const Eigen::VectorXd before =
        unit_mode(mode.frequency - frequency, mode.decay - decay, filter_, step_s_, data_.size());
    return mode.amplitude / (2 * (frequency + decay)) * (after - before);
  }

  Eigen::VectorXd data_;
  const BandFilter& filter_;
  double step_s_;
  Eigen::Index rigid_;
};

/// The poles moved by a part of the Gauss-Newton step; a decay stays positive.
ModalFit moved(const ModalFit& fit, const Eigen::VectorXd& step, Eigen::Index offset, double part) {
  ModalFit next = fit;
  const auto count = static_cast<Eigen::Index>(fit.modes.size());
  for (Eigen::Index m = 0; m < count; ++m) {
    FittedMode& mode = next.modes[static_cast<std::size_t>(m)];
    mode.frequency += part * step(offset + count + m);
    mode.decay = std::max(0.1 * mode.decay, mode.decay + part * step(offset + 2 * count + m));
  }
  return next;
}

void add_standard_deviations(const Problem& problem, ModalFit& fit) {
  const Eigen::MatrixXd jacobian = problem.jacobian(fit);
  const Eigen::Index spare = problem.size() - jacobian.cols();
  require(spare > 0, "{} samples in the band do not determine {} modes", problem.size(), fit.modes.size());
  // Columns of unit length, because amplitudes and rad/s do not compare.
  const Eigen::VectorXd scale = jacobian.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd scaled = jacobian * scale.asDiagonal();
  const Eigen::MatrixXd inverse =
      (scaled.transpose() * scaled).ldlt().solve(Eigen::MatrixXd::Identity(scaled.cols(), scaled.cols()));
  const double variance = fit.residual_norm * fit.residual_norm / static_cast<double>(spare);
  for (std::size_t m = 0; m < fit.modes.size(); ++m) {
    const Eigen::Index at = problem.rigid_count() + static_cast<Eigen::Index>(m);
    fit.modes[m].share = std::abs(fit.modes[m].amplitude) * jacobian.col(at).norm() / problem.norm();
    fit.modes[m].amplitude_std = scale(at) * std::sqrt(std::abs(inverse(at, at)) * variance);
  }
}

}  // namespace

double FittedMode::angular_frequency() const { return std::hypot(frequency, decay); }

ModalFit fitted_modes(const std::vector<double>& filtered, const BandFilter& filter, double step_s,
                      std::vector<FittedMode> start, RigidTerm rigid) {
  const Problem problem(filtered, filter, step_s, rigid);
  ModalFit fit{std::move(start), 0, 0};
  if (fit.modes.empty() && rigid == RigidTerm::none) {
    fit.residual_norm = Eigen::Map<const Eigen::VectorXd>(filtered.data(), problem.size()).norm();
    return fit;
  }
  Eigen::VectorXd residual = problem.fit_amplitudes(fit);
  for (int iteration = 0; iteration < 50 && !fit.modes.empty(); ++iteration) {
    const Eigen::VectorXd step = problem.jacobian(fit).colPivHouseholderQr().solve(residual);
    bool better = false;
    const double before = fit.residual_norm;
    for (double part = 1; part > 1e-3 && !better; part /= 2) {
      ModalFit next = moved(fit, step, problem.rigid_count(), part);
      Eigen::VectorXd rest = problem.fit_amplitudes(next);
      better = next.residual_norm < fit.residual_norm;
      if (better) {
        fit = std::move(next);
        residual = std::move(rest);
      }
    }
    if (!better || before - fit.residual_norm < 1e-10 * before) break;
  }
  if (!fit.modes.empty()) add_standard_deviations(problem, fit);
  return fit;
}

}  // namespace impulse
