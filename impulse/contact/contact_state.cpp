#include "impulse/contact/contact_state.hpp"

#include "impulse/contact/step_means.hpp"
#include "lib/contract/require.hpp"
#include "lib/law/contact_trace.hpp"
#include "lib/numerics/roots.hpp"

#include <cmath>

namespace impulse {

SeriesLaw::SeriesLaw(const ContactLaw& law, double residual_flexibility_m_per_N, double own_compliance)
    : law_(law.is_rigid() && residual_flexibility_m_per_N > 0 ? ContactLaw::linear(1 / residual_flexibility_m_per_N)
                                                              : law),
      is_residual_(law.is_rigid() && residual_flexibility_m_per_N > 0),
      settles_(is_residual_ && own_compliance > 2 * residual_flexibility_m_per_N),
      residual_(is_residual_ ? 0 : residual_flexibility_m_per_N) {}

double SeriesLaw::approach(double a, const LawHistory& history) const {
  return residual_ == 0 ? a : a + residual_ * law_.force(a, history);
}

double SeriesLaw::stiffness(double a, const LawHistory& history) const {
  const double own = law_.tangent(a, history);
  return own / (1 + residual_ * own);
}

// By Simpson's rule where the difference of energies would be rounding; the residual flexibility takes its share of the
// way, under the mean of the ends.
double SeriesLaw::mean_force(const LawHistory& history, double from, double to) const {
  const double f_from = law_.force(from, history);
  const double f_to = law_.force(to, history);
  if (from == to || settles_) return f_to;
  if (std::abs(to - from) < 1e-3 * std::max(std::abs(from), std::abs(to))) {
    const double own = (f_from + 4 * law_.force(0.5 * (from + to), history) + f_to) / 6;
    const double share = residual_ * (f_to - f_from) / (to - from);
    return (own + share * 0.5 * (f_from + f_to)) / (1 + share);
  }
  const double distance = approach(to, history) - approach(from, history);
  const double springs = 0.5 * residual_ * (f_to - f_from) * (f_to + f_from);
  const LawHistory after = law_.advanced(history, to);
  const double taken_up =
      law_.stored_energy(to, after) + after.dissipated_J - law_.stored_energy(from, history) - history.dissipated_J;
  return (taken_up + springs) / distance;
}

ContactState::ContactState(const MarchedContact& given, double own_compliance, std::size_t size)
    : given_(given),
      interface_(given.law, given.residual_flexibility_m_per_N, own_compliance),
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
  proposed_end_ = indentation_;
  result_.mean_force_N.reserve(size - 1);
  record();
}

double ContactState::force_for(double free) {
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

double ContactState::proposed_law_force() const {
  return interface_.is_rigid() || finished_ ? 0 : interface_.law().force(proposed_end_, history_);
}

void ContactState::accept(double force, double free) {
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

void ContactState::finish_if_open(Recontact recontact) {
  const std::size_t open_for = interface_.is_rigid() ? samples_that_end_a_rigid_contact : 0;
  if (recontact == Recontact::no && touched_ && !closed() && open_steps_ >= open_for) finished_ = true;
}

MarchedHistory ContactState::take() {
  if (interface_.is_rigid()) {
    const std::vector<double>& mean = result_.mean_force_N;
    result_.force_N = on_samples(mean, mean.front(), mean.back());
    for (std::size_t n = 0; n < result_.in_contact.size(); ++n) {
      const bool bears = (n > 0 && mean[n - 1] > 0) || (n < mean.size() && mean[n] > 0);
      result_.in_contact[n] = bears && result_.indentation_m[n] == 0;
    }
    bridge_wave_fronts(result_.in_contact);
  }
  return std::move(result_);
}

// The law's indentation at the step's end. Force and indentation grow together, so it lies between the free one and
// that under the force there.
double ContactState::end_indentation(double free, double opens_at) const {
  const auto excess = [&](double end) {
    return interface_.approach(end, history_) - free + compliance_ * interface_.mean_force(history_, indentation_, end);
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

void ContactState::settle_preload() {
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

bool ContactState::closed() const {
  if (finished_) return false;
  return interface_.is_rigid() ? indentation_ >= 0 && last_force_ > 0
                               : indentation_ > interface_.law().permanent_indentation(history_);
}

void ContactState::record() {
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

double ContactState::stiffness_ratio() const {
  if (finished_ || given_.law.is_rigid() || indentation_ <= 0) return 0;
  return indentation_ < history_.largest_indentation_m ? 0 : compliance_ * interface_.stiffness(indentation_, history_);
}

}  // namespace impulse
