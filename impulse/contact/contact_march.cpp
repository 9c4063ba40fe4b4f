#include "impulse/contact/contact_march.hpp"

#include "impulse/contact/contact_state.hpp"
#include "lib/contract/errors.hpp"
#include "lib/contract/require.hpp"
#include "lib/law/resolved_law.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {
namespace {

// A body that yielded more to a force elsewhere than to one on the spot would give energy away.
void require_possible_residuals(const std::vector<MarchedContact>& contacts, std::size_t i) {
  const std::vector<double>& across = contacts[i].residual_flexibility_across_m_per_N;
  require(across.empty() || across.size() == contacts.size(),
          "contact {}: residual flexibilities of {} contacts for {}", i + 1, across.size(), contacts.size());
  for (std::size_t j = 0; j < across.size(); ++j) {
    const double most = std::sqrt(contacts[i].residual_flexibility_m_per_N * contacts[j].residual_flexibility_m_per_N);
    require(
        j == i || std::abs(across[j]) <= (1 + 1e-6) * most,
        "contacts {} and {}: 1 N at one moves the other at once by {:.4g} m, but at most √(R{}{} R{}{}) = {:.4g} m is "
        "possible (step displacements at t = 0, or residual flexibilities)",
        i + 1, j + 1, across[j], i + 1, i + 1, j + 1, j + 1, most);
  }
}

void require_consistent(const UniformGrid& grid, const std::vector<MarchedContact>& contacts,
                        const ForceHistory& history) {
  const std::size_t p = contacts.size();
  require(p > 0 && grid.size >= 4, "a march needs a contact and 4 samples, not {} and {}", p, grid.size);
  require(history.contact_count() == p, "a history of {} contacts for {}", history.contact_count(), p);
  for (std::size_t i = 0; i < p; ++i) {
    require(contacts[i].approach_m_per_s.size() + 1 == grid.size, "contact {}: {} approach velocities for {} steps",
            i + 1, contacts[i].approach_m_per_s.size(), grid.size - 1);
    require(history.within_step(i, i) > 0,
            "contact {}: the bodies do not yield at all within a step of {} s (two rigid walls?)", i + 1, grid.step_s);
    require_possible_residuals(contacts, i);
  }
}

class March {
 public:
  March(const UniformGrid& grid, const std::vector<MarchedContact>& given, ForceHistory& history)
      : grid_(grid),
        history_(history),
        force_(given.size(), 0.0),
        beyond_preload_(given.size()),
        base_(given.size()),
        free_(given.size()) {
    contacts_.reserve(given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
      contacts_.emplace_back(given[i], grid.step_s * history.within_step(i, i), grid.size);
      for (std::size_t j = 0; j < given.size(); ++j) {
        within_.push_back(history.within_step(i, j));
        const std::vector<double>& across = given[i].residual_flexibility_across_m_per_N;
        residual_across_.push_back(i == j || across.empty() ? 0 : across[j]);
        coupled_ = coupled_ || residual_across_.back() != 0 || (i != j && within_.back() != 0);
      }
    }
  }

  std::vector<MarchedHistory> run(Recontact recontact) {
    for (std::size_t n = 0; n + 1 < grid_.size; ++n) {
      settle(n);
      for (std::size_t i = 0; i < contacts_.size(); ++i) {
        contacts_[i].accept(force_[i], free_[i]);
        require_resolved_law(contacts_[i].stiffness_ratio(), i + 1, grid_.step_s);
        contacts_[i].finish_if_open(recontact);
        beyond_preload_[i] = force_[i] - contacts_[i].preload();
      }
      history_.push(beyond_preload_);
    }
    std::vector<MarchedHistory> result;
    for (ContactState& contact : contacts_) result.push_back(contact.take());
    add_residuals_across(result);
    return result;
  }

 private:
  void add_residuals_across(std::vector<MarchedHistory>& histories) const {
    for (std::size_t i = 0; i < histories.size(); ++i)
      for (std::size_t j = 0; j < histories.size(); ++j) {
        const double r = residual_across_[i * histories.size() + j];
        for (std::size_t n = 0; r != 0 && n < grid_.size; ++n) {
          histories[i].approach_m[n] += r * histories[j].force_N[n];
          histories[i].residual_J[n] += 0.5 * r * histories[i].force_N[n] * histories[j].force_N[n];
        }
      }
  }

  /// The forces of step n: Gauss-Seidel over the contacts; one sweep settles it unless they feel each other within the
  /// step.
  void settle(std::size_t n) {
    const double dt = grid_.step_s;
    const std::size_t p = contacts_.size();
    for (std::size_t i = 0; i < p; ++i) {
      base_[i] = contacts_[i].approach() +
                 dt * (contacts_[i].free_velocity(n) - history_.past(i) + within_[i * p + i] * contacts_[i].preload());
      for (std::size_t j = 0; j < p; ++j) base_[i] += residual_across_[i * p + j] * contacts_[j].law_force();
    }
    for (std::size_t sweep = 0;; ++sweep) {
      double change = 0;
      double size = 0;
      for (std::size_t i = 0; i < p; ++i) {
        free_[i] = base_[i];
        for (std::size_t j = 0; j < p; ++j)
          if (j != i)
            free_[i] -= dt * within_[i * p + j] * (force_[j] - contacts_[j].preload()) +
                        residual_across_[i * p + j] * contacts_[j].proposed_law_force();
        const double now = contacts_[i].force_for(free_[i]);
        change = std::max(change, std::abs(now - force_[i]));
        size = std::max(size, std::abs(now));
        force_[i] = now;
      }
      if (!coupled_ || change <= settled * size) return;
      if (sweep == 1000)
        throw ConvergenceError(fmt::format("the contacts do not settle at {:.6g} s (forces still change by {:.2g} of "
                                           "the largest); use a shorter step",
                                           grid_.time_s(n), change / size),
                               settled, change / size, sweep);
    }
  }

  /// Change of the forces, of the largest: a difference of energies over a thousandth of the indentation, which is what
  /// mean_force takes, is rounded to some 1e-13.
  static constexpr double settled = 1e-12;

  const UniformGrid& grid_;
  ForceHistory& history_;
  std::vector<ContactState> contacts_;
  std::vector<double> within_;           ///< w_ij,0
  std::vector<double> residual_across_;  ///< R_ij, i ≠ j
  std::vector<double> force_;
  std::vector<double> beyond_preload_;
  std::vector<double> base_;  ///< approach at the step's end without the forces of this step
  std::vector<double> free_;  ///< the same without that of the own contact
  bool coupled_ = false;
};

}  // namespace

std::vector<MarchedHistory> march_contacts(const UniformGrid& grid, const std::vector<MarchedContact>& contacts,
                                           ForceHistory& history, Recontact recontact) {
  require_consistent(grid, contacts, history);
  return March(grid, contacts, history).run(recontact);
}

std::vector<MarchedHistory> march_contacts(const UniformGrid& grid, const std::vector<MarchedContact>& contacts,
                                           const std::vector<std::vector<double>>& weights, Recontact recontact) {
  for (const std::vector<double>& w : weights)
    require(w.size() + 1 == grid.size, "a kernel has {} weights where {} samples need {}", w.size(), grid.size,
            grid.size - 1);
  ConvolutionHistory history(weights, contacts.size());
  return march_contacts(grid, contacts, history, recontact);
}

}  // namespace impulse
