#include "impulse/measured/mode_identification.hpp"

#include "impulse/measured/exponential_subspace.hpp"
#include "impulse/measured/modal_fit.hpp"
#include "impulse/response/modal_response.hpp"
#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace impulse {
namespace {

using std::numbers::pi;

/// Poles must stay for so many orders to count.
constexpr std::size_t least_run = 4;
constexpr double frequency_tolerance = 0.005;
constexpr double damping_tolerance = 0.1;
/// A mode's φ² in standard deviations below which it may be noise: the highest of a thousand peaks of noise has 4, and
/// a little more once frequency and damping are fitted to it.
constexpr double least_significance = 7;
/// Its share of the response below which it may be what the filter lets through from above the band, 74 dB down.
constexpr double least_share = 1e-3;

/// A pole with the number of orders in a row that it has been there for.
struct TrackedPole {
  FittedMode mode;
  std::size_t run = 1;
};

bool same_pole(const FittedMode& a, const FittedMode& b) {
  return std::abs(a.angular_frequency() - b.angular_frequency()) < frequency_tolerance * b.angular_frequency() &&
         std::abs(a.damping_ratio() - b.damping_ratio()) < damping_tolerance * b.damping_ratio();
}

std::vector<FittedMode> modes_of(const std::vector<std::complex<double>>& poles, double interval_s, double highest_Hz) {
  std::vector<FittedMode> modes;
  for (std::complex<double> z : poles) {
    if (z.imag() <= 0 || std::abs(z) >= 1) continue;
    const std::complex<double> lambda = std::log(z) / interval_s;
    const FittedMode mode{lambda.imag(), -lambda.real()};
    if (mode.angular_frequency() <= 2 * pi * highest_Hz && mode.damping_ratio() < 0.5) modes.push_back(mode);
  }
  std::ranges::sort(modes, {}, &FittedMode::frequency);
  return modes;
}

struct Diagram {
  std::vector<StabilisationPoint> points;
  std::vector<FittedMode> stable;  ///< poles of long runs, as last seen
};

Diagram diagram(const std::vector<double>& filtered, double interval_s, const IdentificationOptions& options) {
  const ExponentialSubspace subspace(filtered);
  const Eigen::Index rigid = options.rigid_body == RigidBody::free ? 1 : 0;
  Diagram result;
  std::vector<TrackedPole> before;
  std::vector<TrackedPole> kept;
  for (std::size_t order = 1; order <= options.largest_order; ++order) {
    const Eigen::Index dimension = 2 * static_cast<Eigen::Index>(order) + rigid;
    if (dimension > subspace.largest_dimension()) break;
    std::vector<TrackedPole> now;
    for (const FittedMode& mode : modes_of(subspace.poles(dimension), interval_s, options.highest_frequency_Hz)) {
      const auto match = std::ranges::find_if(before, [&](const TrackedPole& p) { return same_pole(mode, p.mode); });
      const bool stable = match != before.end();
      now.push_back({mode, stable ? match->run + 1 : 1});
      result.points.push_back({order, mode.angular_frequency() / (2 * pi), mode.damping_ratio(), stable});
    }
    // What ends here after a long run is remembered as it was, unless it goes on under another order later.
    for (const TrackedPole& pole : now)
      if (pole.run >= least_run) {
        std::erase_if(kept, [&](const TrackedPole& p) { return same_pole(p.mode, pole.mode); });
        kept.push_back(pole);
      }
    before = std::move(now);
  }
  for (const TrackedPole& pole : kept) result.stable.push_back(pole.mode);
  return result;
}

/// Fits, and drops the least significant mode until all are significant and no more than wanted.
ModalFit significant_fit(const std::vector<double>& filtered, const BandFilter& filter, double step_s,
                         std::vector<FittedMode> modes, const IdentificationOptions& options) {
  const RigidTerm rigid = options.rigid_body == RigidBody::free ? RigidTerm::fitted : RigidTerm::none;
  const auto significance = [](const FittedMode& mode) { return mode.amplitude / mode.amplitude_std; };
  for (;;) {
    ModalFit fit = fitted_modes(filtered, filter, step_s, modes, rigid);
    if (fit.modes.empty()) return fit;
    const auto weakest = std::ranges::min_element(fit.modes, {}, significance);
    const auto smallest = std::ranges::min_element(fit.modes, {}, &FittedMode::share);
    const bool too_many = options.modes && fit.modes.size() > *options.modes;
    if (too_many || significance(*weakest) < least_significance)
      fit.modes.erase(weakest);
    else if (smallest->share < least_share)
      fit.modes.erase(smallest);
    else
      return fit;
    modes = std::move(fit.modes);
  }
}

ModalModel modal_model_of(ModalFit fit, const IdentificationOptions& options) {
  std::ranges::sort(fit.modes, {}, [](const FittedMode& mode) { return mode.angular_frequency(); });
  const double rigid = options.rigid_body == RigidBody::known ? 1 / options.mass_kg : fit.rigid;
  const Eigen::Index first = options.rigid_body == RigidBody::held ? 0 : 1;
  require(first == 0 || rigid > 0, "the body's mass would be {} kg; it is not free, or the response has a drift",
          1 / rigid);
  const Eigen::Index count = first + static_cast<Eigen::Index>(fit.modes.size());
  ModalModel model{Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count), Eigen::MatrixXd::Zero(count, 1),
                   Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Zero(1, 1)};
  if (first == 1) model.participation(0, 0) = std::sqrt(rigid);
  for (std::size_t m = 0; m < fit.modes.size(); ++m) {
    const auto row = first + static_cast<Eigen::Index>(m);
    model.angular_frequency(row) = fit.modes[m].angular_frequency();
    model.damping_ratio(row) = fit.modes[m].damping_ratio();
    model.participation(row, 0) = std::sqrt(fit.modes[m].amplitude);
  }
  return model;
}

double mean_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t n = 1; n < a.size(); ++n) sum += a[n] - b[n];
  return sum / static_cast<double>(a.size() - 1);
}

}  // namespace

Identification identified_modes(const Response& response, const IdentificationOptions& options) {
  require(response.contact_count == 1, "modes are identified at one contact; the response has {}",
          response.contact_count);
  require(options.largest_order >= 2, "an order of {} shows no stability; allow for 2 modes at least",
          options.largest_order);
  require(options.rigid_body != RigidBody::known || options.mass_kg > 0, "mass {} kg is not positive", options.mass_kg);
  const double step = response.grid.step_s;
  require(options.highest_frequency_Hz > 0 && options.highest_frequency_Hz * step <= 0.5,
          "the highest frequency {} Hz is not between 0 and half the sampling frequency, {} Hz",
          options.highest_frequency_Hz, 0.5 / step);
  const std::vector<double>& u = response.pairs.front().step_displacement_m_per_N;
  std::vector<double> mean_impulse_response;
  const double known = options.rigid_body == RigidBody::known ? 1 / options.mass_kg : 0;
  for (std::size_t k = 1; k + 1 < u.size(); ++k)
    mean_impulse_response.push_back((u[k + 1] - 2 * u[k] + u[k - 1]) / (step * step) - known);

  const BandFilter filter(options.highest_frequency_Hz * step);
  const std::vector<double> filtered = filter.filtered(mean_impulse_response);
  const double interval = step * static_cast<double>(filter.decimation());
  Diagram found = diagram(filtered, interval, options);
  const ModalFit fit = significant_fit(filtered, filter, step, std::move(found.stable), options);
  require(!fit.modes.empty() || options.rigid_body == RigidBody::free,
          "no mode up to {} Hz stands out of the noise; use a higher --order or another band",
          options.highest_frequency_Hz);
  const double norm =
      Eigen::Map<const Eigen::VectorXd>(filtered.data(), static_cast<Eigen::Index>(filtered.size())).norm();
  Identification result{modal_model_of(fit, options), std::move(found.points), fit.residual_norm / norm};
  if (options.residual == IdentificationOptions::Residual::fitted) {
    const Response modal = modal_response(result.modes, response.grid);
    const double flexibility = mean_difference(u, modal.pairs.front().step_displacement_m_per_N);
    require(flexibility >= 0, "the residual flexibility would be {} m/N; U drifts: leave the residual out",
            flexibility);
    result.modes.residual_flexibility(0, 0) = flexibility;
  }
  return result;
}

}  // namespace impulse
