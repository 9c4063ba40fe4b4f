#include "impulse/contact/contact_march.hpp"

#include "impulse/contact/step_means.hpp"
#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/numerics/roots.hpp"
#include "lib/transform/causal_convolution.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace impulse {
namespace {

/// A law with the bodies' residual flexibility R in series: at the law's indentation a the bodies have approached by a
/// + R F, and the energy taken up is E + R F²/2. A rigid contact with R > 0 is the spring 1/R.
class Interface {
 public:
  Interface(const ContactLaw& law, double residual)
      : law_(law.is_rigid() && residual > 0 ? ContactLaw::linear(1 / residual) : law),
        is_residual_(law.is_rigid() && residual > 0),
        residual_(is_residual_ ? 0 : residual) {}

  [[nodiscard]] bool is_rigid() const { return law_.is_rigid(); }
  [[nodiscard]] const ContactLaw& law() const { return law_; }
  [[nodiscard]] double approach(double a, const LawHistory& history) const {
    return residual_ == 0 ? a : a + residual_ * law_.force(a, history);
  }
  /// What is left of an approach for the surfaces themselves.
  [[nodiscard]] double surface_indentation(double a) const { return is_residual_ ? std::min(a, 0.0) : a; }

  /// Mean force over a path from one indentation to another, by the energy taken up; by Simpson's rule where the
  /// difference of energies would be rounding.
  [[nodiscard]] double mean_force(const LawHistory& history, double from, double to) const {
    if (residual_ == 0 && std::abs(to - from) < 1e-3 * std::max(std::abs(from), std::abs(to))) {
      const double middle = law_.force(0.5 * (from + to), history);
      return (law_.force(from, history) + 4 * middle + law_.force(to, history)) / 6;
    }
    const double distance = approach(to, history) - approach(from, history);
    if (distance == 0) return law_.force(to, history);
    const double f_from = law_.force(from, history);
    const double f_to = law_.force(to, history);
    const double springs = 0.5 * residual_ * (f_to - f_from) * (f_to + f_from);
    const LawHistory after = law_.advanced(history, to);
    const double taken_up =
        law_.stored_energy(to, after) + after.dissipated_J - law_.stored_energy(from, history) - history.dissipated_J;
    return (taken_up + springs) / distance;
  }

 private:
  ContactLaw law_;
  bool is_residual_;
  double residual_;
};

/// State of one contact while it is marched.
class Contact {
 public:
  Contact(const MarchedContact& given, double own_compliance, std::size_t size)
      : given_(given),
        interface_(given.law, given.residual_flexibility_m_per_N),
        compliance_(own_compliance),
        indentation_(0.0 - given.gap_m) {
    require(given.preload_N >= 0, "preload {} N is negative", given.preload_N);
    require(given.preload_N == 0 || given.gap_m == 0, "a preload of {} N and a gap of {} m exclude each other",
            given.preload_N, given.gap_m);
    require(given.gap_m >= 0, "gap {} m is negative", given.gap_m);
    if (given.preload_N > 0 && !interface_.is_rigid()) settle_preload();
    last_force_ = given.preload_N;
    touched_ = given.preload_N > 0;
    approach_ = interface_.is_rigid() ? indentation_ : interface_.approach(indentation_, history_);
    result_.mean_force_N.reserve(size - 1);
    record();
  }

  /// Mean force over the step in which the bodies would approach to `free` without a force of this contact's own. The
  /// last call before accept counts.
  [[nodiscard]] double force_for(double free) {
    proposed_end_ = free;
    if (finished_) return 0;
    if (interface_.is_rigid()) {
      // Faces that fly together touch by rounding only; that is no contact.
      const double force = free / compliance_;
      return force > 1e-10 * largest_force_ ? force : 0;
    }
    const double opens_at = interface_.law().permanent_indentation(history_);
    if (free <= opens_at && indentation_ <= opens_at) return 0;
    proposed_end_ = end_indentation(free, opens_at);
    return interface_.mean_force(history_, indentation_, proposed_end_);
  }

  void accept(double force, double free) {
    const double before = approach_;
    approach_ = free - compliance_ * force;
    if (interface_.is_rigid()) {
      // A rigid contact that bears is closed exactly, and one that arrives on a sample to rounding arrives there: a gap
      // of rounding would cost force times gap at closing and grow with every bounce.
      if (force > 0 || approach_ > 0 || std::abs(approach_) < 1e-9 * std::abs(approach_ - before)) approach_ = 0;
      indentation_ = approach_;
    } else {
      indentation_ = proposed_end_;
      if (!finished_) history_ = interface_.law().advanced(history_, indentation_);
    }
    touched_ = touched_ || force > 0;
    open_steps_ = force > 0 ? 0 : open_steps_ + 1;
    last_force_ = force;
    largest_force_ = std::max(largest_force_, force);
    result_.mean_force_N.push_back(force);
    record();
  }

  void finish_if_open(Recontact recontact) {
    const std::size_t patience = interface_.is_rigid() ? 3 : 0;
    if (recontact == Recontact::no && touched_ && !closed() && open_steps_ >= patience) finished_ = true;
  }

  [[nodiscard]] double approach() const { return approach_; }
  [[nodiscard]] double preload() const { return given_.preload_N; }
  [[nodiscard]] double free_velocity(std::size_t step) const { return given_.approach_m_per_s[step]; }

  [[nodiscard]] MarchedHistory take() {
    if (interface_.is_rigid()) {
      const std::vector<double>& mean = result_.mean_force_N;
      result_.force_N = on_samples(mean, mean.front(), mean.back());
      for (std::size_t n = 0; n < result_.in_contact.size(); ++n) {
        const bool bears = (n > 0 && mean[n - 1] > 0) || (n < mean.size() && mean[n] > 0);
        result_.in_contact[n] = bears && result_.indentation_m[n] == 0;
      }
      for (std::size_t n = 1; n < mean.size(); ++n) result_.force_N[n] = 0.5 * (mean[n - 1] + mean[n]);
      result_.force_N[mean.size()] = mean.back();
    }
    return std::move(result_);
  }

 private:
  /// Law's indentation at the step's end. Force and indentation grow together, so it lies between the free one and that
  /// under the force there.
  [[nodiscard]] double end_indentation(double free, double opens_at) const {
    const auto excess = [&](double end) {
      return interface_.approach(end, history_) - free +
             compliance_ * interface_.mean_force(history_, indentation_, end);
    };
    const double high = std::min(std::max(free, opens_at), interface_.law().largest_possible_indentation_m());
    if (excess(high) < 0)
      throw std::invalid_argument(fmt::format(
          "the contact is pressed to {:.4g} m, beyond the last point of its law's table ({:.4g} m)", free, high));
    double low = std::min({opens_at, indentation_, free}) - 1e-300;
    while (excess(low) > 0) low -= std::max(high - low, 1e-300);
    const double scale = std::max({std::abs(free), std::abs(indentation_), std::abs(low)});
    return bracketed_root(excess, low, high, {.absolute = 1e-17 * scale + 1e-300, .relative = 1e-15});
  }

  void settle_preload() {
    const auto excess = [&](double a) { return interface_.law().force(a, history_) - given_.preload_N; };
    double high = std::min(1e-9, interface_.law().largest_possible_indentation_m());
    while (excess(high) < 0) {
      require(high < interface_.law().largest_possible_indentation_m(),
              "the contact law never reaches the preload of {} N", given_.preload_N);
      high = std::min(2 * high, interface_.law().largest_possible_indentation_m());
    }
    indentation_ = bracketed_root(excess, 0, high, {.absolute = 1e-300, .relative = 1e-15});
    history_ = interface_.law().advanced(history_, indentation_);
  }

  [[nodiscard]] bool closed() const {
    if (finished_) return false;
    return interface_.is_rigid() ? indentation_ >= 0 && last_force_ > 0
                                 : indentation_ > interface_.law().permanent_indentation(history_);
  }
  void record() {
    const bool springless = interface_.is_rigid() || finished_;
    result_.indentation_m.push_back(interface_.surface_indentation(indentation_));
    result_.approach_m.push_back(approach_);
    result_.force_N.push_back(springless ? 0 : interface_.law().force(indentation_, history_));
    const double force = result_.force_N.back();
    result_.stored_J.push_back(
        springless || given_.law.is_rigid() ? 0 : interface_.law().stored_energy(indentation_, history_));
    result_.residual_J.push_back(0.5 * given_.residual_flexibility_m_per_N * force * force);
    result_.dissipated_J.push_back(history_.dissipated_J);
    result_.in_contact.push_back(closed());
  }

  const MarchedContact& given_;
  Interface interface_;
  double compliance_;  ///< Δt w_ii,0
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

/// Σ_{k<n} w_ij,n-k x_j,k for all i; kernels that vanish are skipped.
class CoupledHistory {
 public:
  CoupledHistory(const std::vector<std::vector<double>>& weights, std::size_t count) : count_(count) {
    for (const std::vector<double>& w : weights) {
      const bool zero = std::ranges::all_of(w, [](double value) { return value == 0; });
      pairs_.push_back(zero ? nullptr : std::make_unique<CausalConvolution>(w));
    }
  }
  [[nodiscard]] double at(std::size_t i) const {
    double sum = 0;
    for (std::size_t j = 0; j < count_; ++j)
      if (pairs_[i * count_ + j]) sum += pairs_[i * count_ + j]->history();
    return sum;
  }
  void push(std::size_t j, double value) {
    for (std::size_t i = 0; i < count_; ++i)
      if (pairs_[i * count_ + j]) pairs_[i * count_ + j]->push(value);
  }

 private:
  std::size_t count_;
  std::vector<std::unique_ptr<CausalConvolution>> pairs_;
};

void require_consistent(const UniformGrid& grid, const std::vector<MarchedContact>& contacts,
                        const std::vector<std::vector<double>>& weights) {
  const std::size_t p = contacts.size();
  require(p > 0 && grid.size >= 4, "a march needs a contact and 4 samples, not {} and {}", p, grid.size);
  require(weights.size() == p * p, "{} contacts need {} kernels, not {}", p, p * p, weights.size());
  for (const std::vector<double>& w : weights)
    require(w.size() + 1 == grid.size, "a kernel has {} weights where {} samples need {}", w.size(), grid.size,
            grid.size - 1);
  for (std::size_t i = 0; i < p; ++i) {
    require(contacts[i].approach_m_per_s.size() + 1 == grid.size, "contact {}: {} approach velocities for {} steps",
            i + 1, contacts[i].approach_m_per_s.size(), grid.size - 1);
    require(weights[i * p + i][0] > 0,
            "contact {}: the bodies do not yield at all within a step of {} s (two rigid walls?)", i + 1, grid.step_s);
  }
}

}  // namespace

std::vector<MarchedHistory> march_contacts(const UniformGrid& grid, const std::vector<MarchedContact>& given,
                                           const std::vector<std::vector<double>>& weights, Recontact recontact) {
  require_consistent(grid, given, weights);
  const std::size_t p = given.size();
  const double dt = grid.step_s;
  std::vector<Contact> contacts;
  contacts.reserve(p);
  for (std::size_t i = 0; i < p; ++i) contacts.emplace_back(given[i], dt * weights[i * p + i][0], grid.size);
  CoupledHistory past(weights, p);
  std::vector<double> force(p, 0.0);
  std::vector<double> base(p);
  std::vector<double> free(p);
  bool coupled = false;
  for (std::size_t i = 0; i < p; ++i)
    for (std::size_t j = 0; j < p; ++j) coupled = coupled || (i != j && weights[i * p + j][0] != 0);

  for (std::size_t n = 0; n + 1 < grid.size; ++n) {
    for (std::size_t i = 0; i < p; ++i)
      base[i] = contacts[i].approach() +
                dt * (contacts[i].free_velocity(n) - past.at(i) + weights[i * p + i][0] * contacts[i].preload());
    // Gauss-Seidel over the contacts: one sweep settles it unless they feel each other within the step.
    for (int sweep = 0;; ++sweep) {
      double change = 0;
      double size = 0;
      for (std::size_t i = 0; i < p; ++i) {
        free[i] = base[i];
        for (std::size_t j = 0; j < p; ++j)
          if (j != i) free[i] -= dt * weights[i * p + j][0] * (force[j] - contacts[j].preload());
        const double now = contacts[i].force_for(free[i]);
        change = std::max(change, std::abs(now - force[i]));
        size = std::max(size, std::abs(now));
        force[i] = now;
      }
      if (!coupled || change <= 1e-13 * size) break;
      if (sweep == 1000)
        throw ConvergenceError(fmt::format("the contacts do not settle at {:.6g} s (forces still change by {:.2g} of "
                                           "the largest); use a shorter step",
                                           grid.time_s(n), change / size),
                               1e-13, change / size, 1000);
    }
    for (std::size_t i = 0; i < p; ++i) {
      contacts[i].accept(force[i], free[i]);
      contacts[i].finish_if_open(recontact);
      past.push(i, force[i] - contacts[i].preload());
    }
  }
  std::vector<MarchedHistory> result;
  for (Contact& contact : contacts) result.push_back(contact.take());
  return result;
}

}  // namespace impulse
