#include "impulse/exact/beam_modes.hpp"

#include "impulse/exact/beam_statics.hpp"
#include "lib/contract/require.hpp"
#include "lib/numerics/roots.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace impulse {
namespace {

using std::numbers::pi;

/// β of elastic mode n = 1, 2, ...; both conditions are divided by cosh β, so that nothing overflows.
double wave_number(BeamSupports supports, int n) {
  if (supports == BeamSupports::simple) return n * pi;
  const bool cantilever = supports == BeamSupports::cantilever;
  const double sign = cantilever ? 1 : -1;
  const auto condition = [sign](double beta) {
    const double decay = std::exp(-beta);
    return std::cos(beta) + sign * 2 * decay / (1 + decay * decay);
  };
  const double low = (cantilever ? n - 1 : n) * pi;
  return bracketed_root(condition, low, low + pi);
}

double simple_shape(int n, double at) { return std::numbers::sqrt2 * std::sin(pi * std::remainder(n * at, 2.0)); }

/// Of a beam with like ends, about its middle. The hyperbolic part falls away from both ends.
double symmetric_shape(BeamSupports supports, int n, double beta, double at) {
  const double s = at - 0.5;
  const double parity = n % 2 == 1 ? 1 : -1;
  const double hyperbolic =
      (std::exp(-beta * (0.5 - s)) + parity * std::exp(-beta * (0.5 + s))) / (1 + parity * std::exp(-beta));
  const double circular =
      parity > 0 ? std::cos(beta * s) / std::cos(beta / 2) : std::sin(beta * s) / std::sin(beta / 2);
  return supports == BeamSupports::free ? circular + hyperbolic : circular - hyperbolic;
}

double cantilever_shape(double beta, double at) {
  const double decay = std::exp(-beta);
  const double divisor = 1 + 2 * decay * std::cos(beta) + decay * decay;
  const double sigma = (1 - 2 * decay * std::sin(beta) - decay * decay) / divisor;
  return -std::cos(beta * at) + sigma * std::sin(beta * at) + (1 + sigma) / 2 * std::exp(-beta * at) +
         (std::cos(beta) + std::sin(beta) + decay) * std::exp(-beta * (1 - at)) / divisor;
}

double shape(BeamSupports supports, int n, double beta, double at) {
  switch (supports) {
    case BeamSupports::simple:
      return simple_shape(n, at);
    case BeamSupports::cantilever:
      return cantilever_shape(beta, at);
    default:
      return symmetric_shape(supports, n, beta, at);
  }
}

void require_range(const Beam& beam, const ModeRange& range, std::size_t rigid_count) {
  require(std::isfinite(range.highest_frequency_Hz) || range.count < std::numeric_limits<std::size_t>::max(),
          "a beam has infinitely many modes; give a highest frequency or a count");
  require(range.count >= rigid_count,
          "{} mode is asked for, but a free beam has two rigid-body modes; ask for at least 2", range.count);
  const double by_frequency = std::sqrt(2 * pi * range.highest_frequency_Hz / beam.slenderness_frequency()) / pi;
  const double expected = std::min(by_frequency, static_cast<double>(range.count));
  require(expected <= 1e6, "{:.3g} modes are more than can be had (1e6); ask for fewer, or use a longer step",
          expected);
}

/// What the elastic modes leave of the static flexibility. Below the rounding of their sum it is none: R > 0 changes
/// how a contact begins.
Eigen::MatrixXd residual(const Beam& beam, const ModalModel& model, Eigen::Index rigid_count) {
  const Eigen::MatrixXd whole = beam_static_flexibility(beam);
  const Eigen::Index elastic_count = model.mode_count() - rigid_count;
  const Eigen::MatrixXd compliant = model.angular_frequency.tail(elastic_count).cwiseInverse().asDiagonal() *
                                    model.participation.bottomRows(elastic_count);
  Eigen::MatrixXd rest = whole - compliant.transpose() * compliant;
  const double rounding = std::numeric_limits<double>::epsilon() * static_cast<double>(elastic_count + 1);
  for (Eigen::Index i = 0; i < rest.rows(); ++i)
    if (rest(i, i) <= rounding * whole(i, i)) {
      rest.row(i).setZero();
      rest.col(i).setZero();
    }
  return rest;
}

}  // namespace

ModalModel exact_beam_modes(const Beam& beam, const ModeRange& range) {
  require_valid(beam);
  const std::size_t rigid_count = beam.supports == BeamSupports::free ? 2 : 0;
  require_range(beam, range, rigid_count);
  const double unit = beam.slenderness_frequency();
  const double highest = 2 * pi * range.highest_frequency_Hz;
  std::vector<double> beta(rigid_count, 0.0);
  for (int n = 1; beta.size() < range.count; ++n) {
    const double root = wave_number(beam.supports, n);
    if (root * root * unit > highest) break;
    beta.push_back(root);
  }

  const auto mode_count = static_cast<Eigen::Index>(beta.size());
  const auto contact_count = static_cast<Eigen::Index>(beam.contacts_at.size());
  const auto rigid = static_cast<Eigen::Index>(rigid_count);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(contact_count, contact_count);
  ModalModel model{Eigen::VectorXd(mode_count), Eigen::VectorXd::Zero(mode_count),
                   Eigen::MatrixXd(mode_count, contact_count), none, none};
  for (Eigen::Index mode = 0; mode < mode_count; ++mode) {
    const double root = beta[static_cast<std::size_t>(mode)];
    model.angular_frequency(mode) = root * root * unit;
    for (Eigen::Index i = 0; i < contact_count; ++i) {
      const double at = beam.contacts_at[static_cast<std::size_t>(i)];
      const double rigid_shape = mode == 0 ? 1 : std::sqrt(12.0) * (at - 0.5);
      model.participation(mode, i) =
          mode < rigid ? rigid_shape : shape(beam.supports, static_cast<int>(mode - rigid) + 1, root, at);
    }
  }
  model.participation /= std::sqrt(beam.mass_kg());
  model.residual_flexibility = residual(beam, model, rigid);
  return model;
}

}  // namespace impulse
