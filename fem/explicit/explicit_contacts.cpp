#include "fem/explicit/explicit_contacts.hpp"

#include "fem/explicit/contact_recorder.hpp"
#include "fem/explicit/first_forces.hpp"
#include "fem/explicit/force_bisection.hpp"
#include "fem/explicit/joined_bodies.hpp"
#include "fem/explicit/law_contact.hpp"
#include "fem/explicit/step_forces.hpp"
#include "lib/contract/require.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace impulse {
namespace {

/// A force this small against the peak so far is rounding: it counts as none, so that it does not prolong a contact.
constexpr double no_force = 1e-9;

/// Likewise a speed and a distance against the largest speed of approach and its way in a step, for a contact that
/// closes.
constexpr double no_approach = 1e-9;

void require_contacts(const JoinedBodies& bodies, const ExplicitContacts& contacts) {
  const std::size_t count = bodies.contact_count();
  require(contacts.laws.size() == count, "{} laws for {} contacts", contacts.laws.size(), count);
  require(contacts.gaps_m.size() == count, "{} gaps for {} contacts", contacts.gaps_m.size(), count);
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    require(std::isfinite(contacts.gaps_m[i]) && contacts.gaps_m[i] >= 0, "gap {} m is negative", contacts.gaps_m[i]);
    largest = std::max(largest, bodies.flight_speed(i));
  }
  require(largest > 0, "no body flies towards the next one, so they never meet");
  require(contacts.matching == Matching::direct || (count == 1 && contacts.laws[0].is_rigid()),
          "bisection finds the force of one rigid contact; use direct matching");
}

/// A contact between two steps.
struct Contact {
  enum class Rigid { open, sticking, over } rigid = Rigid::open;  ///< of one without a law
  double force_N = 0;                                             ///< of a rigid one, at the last sample
  double peak_N = 0;
  double forgiven_m = 0;
  std::size_t run_without_compression = 0;
};

/// Everything that a return to an earlier sample brings back.
struct RowState {
  std::vector<Snapshot> bodies;
  std::vector<Contact> contacts;
  std::vector<std::optional<LawContact>> laws;
};

/// A rigid contact that lets go in the step to sample `end`.
struct Release {
  std::size_t contact;
  double part;  ///< of the step, where the force is zero
};

/// Drives the bodies and records their contacts sample by sample.
class Run {
 public:
  Run(const std::vector<ExplicitBody>& flights, const ExplicitContacts& contacts)
      : flights_(flights),
        contacts_(contacts),
        grid_(grid_over(contacts.duration_s, contacts.step_s)),
        bodies_(flights, contacts.step_s),
        recorder_(bodies_, flights_, grid_),
        state_{{}, std::vector<Contact>(bodies_.contact_count()), {}} {
    require_contacts(bodies_, contacts);
    for (std::size_t i = 0; i < contacts_count(); ++i) {
      speed_scale_ = std::max(speed_scale_, std::abs(bodies_.flight_speed(i)));
      state_.laws.push_back(law_of(i));
      recorder_.now[i].indentation_m[0] = flight_m(i, 0);
    }
    if (contacts.matching == Matching::bisection) bisection_.emplace(bodies_, contacts.step_s);
  }

  ExplicitContactsResult result() {
    begin();
    for (std::size_t n = 1; n < grid_.size; ++n) n = step(n);
    bool in_contact = false;
    for (std::size_t i = 0; i < contacts_count(); ++i) in_contact = in_contact || is_closed(i);
    if (in_contact) contact_end_s_ = grid_.duration_s();
    if (!finished_) energy_error_ = energy_error(grid_.size - 1);
    ExplicitContactsResult result{grid_,
                                  recorder_.traces(grid_.size),
                                  {},
                                  in_contact,
                                  contact_end_s_,
                                  energy_error_,
                                  trial_count_ + (bisection_ ? bisection_->trial_count() : 0)};
    for (std::size_t i = 0; i < contacts_count(); ++i)
      if (!state_.laws[i]) bridge_wave_fronts(result.traces[i].in_contact);
    for (std::size_t b = 0; b < flights_.size(); ++b)
      result.balances.push_back(balance(bodies_.bodies[b], flights_[b], b));
    return result;
  }

 private:
  [[nodiscard]] std::size_t contacts_count() const { return bodies_.contact_count(); }

  /// With a residual flexibility a rigid contact is a spring.
  [[nodiscard]] std::optional<LawContact> law_of(std::size_t i) const {
    const double residual = bodies_.residual_flexibility()(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
    if (!contacts_.laws[i].is_rigid()) return LawContact(contacts_.laws[i], residual, flight_m(i, 0));
    if (residual > 0) return LawContact(ContactLaw::linear(1 / residual), 0, flight_m(i, 0));
    return std::nullopt;
  }

  [[nodiscard]] bool is_closed(std::size_t i) const {
    return state_.laws[i] ? state_.laws[i]->in_contact() : state_.contacts[i].rigid == Contact::Rigid::sticking;
  }

  [[nodiscard]] bool is_over(std::size_t i) const {
    return state_.laws[i] ? state_.laws[i]->over() : state_.contacts[i].rigid == Contact::Rigid::over;
  }

  [[nodiscard]] std::vector<std::size_t> sticking() const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < contacts_count(); ++i)
      if (state_.contacts[i].rigid == Contact::Rigid::sticking && !is_releasing(i)) found.push_back(i);
    return found;
  }

  [[nodiscard]] bool is_releasing(std::size_t i) const {
    return std::ranges::any_of(releases_, [i](const Release& r) { return r.contact == i; });
  }

  /// Indentation at sample n if the bodies flew on as before impact.
  [[nodiscard]] double flight_m(std::size_t i, std::size_t n) const {
    return bodies_.flight_speed(i) * grid_.time_s(n) - contacts_.gaps_m[i];
  }

  void begin() {
    for (std::size_t i = 0; i < contacts_count(); ++i) {
      if (state_.laws[i] || contacts_.gaps_m[i] > 0 || bodies_.flight_speed(i) <= 0) continue;
      state_.contacts[i].rigid = Contact::Rigid::sticking;
      recorder_.now[i].in_contact[0] = true;
    }
    const std::vector<std::size_t> closed = sticking();
    if (closed.empty()) return;
    const std::optional<Eigen::VectorXd> forces = first_forces(bodies_, closed, bodies_.closing_speed());
    held_start_ = contacts_.start == ImpactStart::held || (contacts_.start == ImpactStart::wave_admittance && !forces);
    if (contacts_.start != ImpactStart::wave_admittance || held_start_) return;
    bodies_.set_forces(*forces);
    for (const std::size_t i : closed) {
      Contact& contact = state_.contacts[i];
      recorder_.now[i].force_N[0] = contact.force_N = contact.peak_N = (*forces)[static_cast<Eigen::Index>(i)];
    }
    recorder_.jump(0, first_velocities(bodies_, *forces));
  }

  /// The step to sample n; returns the sample reached, which is an earlier one where a rigid contact ends.
  std::size_t step(std::size_t n) {
    keep_for_return(n);
    take(n);
    std::vector<Release> found;
    const std::size_t end = n + 1 - std::min(patience(), n);
    for (std::size_t i = 0; i < contacts_count(); ++i) {
      Contact& contact = state_.contacts[i];
      if (contact.rigid != Contact::Rigid::sticking || is_releasing(i)) continue;
      contact.run_without_compression = recorder_.now[i].force_N[n] <= 0 ? contact.run_without_compression + 1 : 0;
      if (contact.run_without_compression < patience()) continue;
      const double zero = contact_end_s(recorder_.now[i].force_N, grid_, end);
      found.push_back({i, (zero - grid_.time_s(end - 1)) / grid_.step_s});
    }
    if (!found.empty()) return release(end, found);
    settle(n);
    return n;
  }

  /// Samples without compression after which a rigid contact lets go; one that may touch again need not wait to see
  /// whether a wave front brings the force back.
  [[nodiscard]] std::size_t patience() const {
    return contacts_.after_contact == AfterContact::touch_again ? 1 : samples_that_end_a_rigid_contact;
  }

  void keep_for_return(std::size_t n) {
    const bool rigid = std::ranges::any_of(
        state_.contacts, [](const Contact& contact) { return contact.rigid == Contact::Rigid::sticking; });
    if (!rigid) return;
    RowState& kept = kept_[n % kept_.size()];
    kept.bodies.resize(bodies_.bodies.size());
    for (std::size_t b = 0; b < kept.bodies.size(); ++b) kept.bodies[b] = bodies_.bodies[b].now;
    kept.contacts = state_.contacts;
    kept.laws = state_.laws;
  }

  /// Back to the last sample in compression of these contacts, and from there with a force that reaches zero.
  std::size_t release(std::size_t end, const std::vector<Release>& found) {
    if (release_end_ != end) releases_.clear();
    release_end_ = end;
    releases_.insert(releases_.end(), found.begin(), found.end());
    const RowState& kept = kept_[end % kept_.size()];
    bodies_.restore(kept.bodies);
    state_.contacts = kept.contacts;
    state_.laws = kept.laws;
    for (ContactTrace& trace : recorder_.now)
      std::fill(trace.force_N.begin() + static_cast<std::ptrdiff_t>(end), trace.force_N.end(), 0.0);
    return step(end);
  }

  /// The bodies from sample n - 1 to n and the record of it.
  void take(std::size_t n) {
    if (release_end_ != n) releases_.clear();
    std::vector<double> power;
    for (const StrikingBody& body : bodies_.bodies) power.push_back(body.dashpot_power());
    const StepForce shape = n == 1 && held_start_ ? StepForce::held : StepForce::ramp;
    const std::vector<std::size_t> closed = sticking();
    const StepForces forces = bisection_ && !closed.empty() ? bisect(shape) : match(n, closed, shape);
    for (std::size_t b = 0; b < power.size(); ++b)
      bodies_.bodies[b].now.dissipated_J += 0.5 * grid_.step_s * (power[b] + bodies_.bodies[b].dashpot_power());
    recorder_.motion(n, forces.law_force_N);
    for (std::size_t i = 0; i < contacts_count(); ++i) {
      if (state_.laws[i])
        record_law(i, n, forces.laws[i]);
      else
        record_rigid(i, n, closed, shape, forces.force_N[static_cast<Eigen::Index>(i)]);
    }
    close(n);
  }

  StepForces bisect(StepForce shape) {
    const double begin = state_.contacts[0].force_N;
    return {Eigen::VectorXd::Constant(1, bisection_->step(begin, shape) - begin), Eigen::VectorXd::Zero(1), {{}}};
  }

  /// Trial and correction.
  StepForces match(std::size_t n, const std::vector<std::size_t>& closed, StepForce shape) {
    ++trial_count_;
    std::vector<StepLoad> loads(contacts_count());
    for (std::size_t i = 0; i < contacts_count(); ++i) {
      if (state_.laws[i]) bodies_.drop_force(i, state_.laws[i]->mean_force_N());
      const double begin = state_.contacts[i].force_N;
      if (state_.contacts[i].rigid == Contact::Rigid::sticking) loads[i] = {begin, begin};
    }
    for (const Release& release : releases_) loads[release.contact].zero_at = release.part;
    bodies_.integrate(loads);
    TrialStep trial{bodies_.closing_speed(), -bodies_.taken_back_m()};
    for (std::size_t i = 0; i < contacts_count(); ++i) trial.approach_m[static_cast<Eigen::Index>(i)] += flight_m(i, n);
    const StepForces forces = step_forces(bodies_, trial, closed, shape, state_.laws);
    apply(bodies_, forces, shape, state_.laws);
    return forces;
  }

  /// Rigid contacts close at the sample nearest to where their faces meet, with a force that jumps there to what a step
  /// of matching would need to bring the faces together. At Courant number 1 that is V/(H₁(0+) + H₂(0+)), which also
  /// stands in the record; below, the faces' lumped masses take more for the first half step. With any other force the
  /// next one would miss as much on the other side, let go, and meet again, for as long as the contact lasts.
  void close(std::size_t n) {
    const Eigen::VectorXd speed = bodies_.closing_speed(), taken_back = bodies_.taken_back_m();
    std::vector<std::size_t> closing;
    for (std::size_t i = 0; i < contacts_count(); ++i) {
      const Contact& contact = state_.contacts[i];
      const Eigen::Index row = static_cast<Eigen::Index>(i);
      if (state_.laws[i] || contact.rigid != Contact::Rigid::open || is_releasing(i)) continue;
      if (speed[row] <= no_approach * speed_scale_) continue;
      const double way = std::max(0.5 * speed[row], no_approach * speed_scale_) * grid_.step_s;
      if (flight_m(i, n) - taken_back[row] - contact.forgiven_m >= -way) closing.push_back(i);
    }
    if (closing.empty()) return;
    const TrialStep apart{speed, Eigen::VectorXd::Zero(speed.size())};
    const Eigen::VectorXd forces =
        step_forces(bodies_, apart, closing, StepForce::ramp, std::vector<std::optional<LawContact>>(contacts_count()))
            .force_N;
    const std::optional<Eigen::VectorXd> known = first_forces(bodies_, closing, speed);
    if (known) recorder_.jump(n, first_velocities(bodies_, *known));
    for (const std::size_t i : closing) {
      Contact& contact = state_.contacts[i];
      ContactTrace& trace = recorder_.now[i];
      const Eigen::Index row = static_cast<Eigen::Index>(i);
      bodies_.drop_force(i, -forces[row]);
      contact.rigid = Contact::Rigid::sticking;
      contact.force_N = forces[row];
      contact.forgiven_m = flight_m(i, n) - taken_back[row];
      trace.force_N[n] = known ? (*known)[row] : forces[row];
      contact.peak_N = std::max(contact.peak_N, trace.force_N[n]);
      trace.indentation_m[n] = 0;
      trace.in_contact[n] = true;
    }
  }

  void record_law(std::size_t i, std::size_t n, const LawContact::Answer& answer) {
    LawContact& law = *state_.laws[i];
    ContactTrace& trace = recorder_.now[i];
    law.accept(answer);
    recorder_.law_step(i, n, answer.mean_force_N);
    trace.force_N[n] = law.force_N();
    trace.indentation_m[n] = law.indentation_m();
    trace.in_contact[n] = law.in_contact();
    trace.stored_J[n] = law.stored_J();
    trace.dissipated_J[n] = law.dissipated_J();
  }

  void record_rigid(std::size_t i, std::size_t n, const std::vector<std::size_t>& closed, StepForce shape,
                    double more_N) {
    Contact& contact = state_.contacts[i];
    ContactTrace& trace = recorder_.now[i];
    const bool sticks = std::ranges::find(closed, i) != closed.end();
    double force = sticks ? contact.force_N + more_N : 0;
    const double begin_N = sticks && shape == StepForce::held ? force : contact.force_N;
    contact.peak_N = std::max(contact.peak_N, force);
    if (std::abs(force) <= no_force * contact.peak_N) force = 0;
    if (shape == StepForce::held) trace.force_N[0] = begin_N;
    trace.force_N[n] = contact.force_N = force;
    const double approach = flight_m(i, n) - bodies_.taken_back_m()[static_cast<Eigen::Index>(i)] - contact.forgiven_m;
    if (sticks) contact.forgiven_m += approach;
    trace.indentation_m[n] = sticks ? 0 : approach;
    trace.in_contact[n] = sticks;
    const auto released = std::ranges::find_if(releases_, [i](const Release& r) { return r.contact == i; });
    if (released == releases_.end()) {
      recorder_.rigid_step(i, n, begin_N, force);
      return;
    }
    recorder_.release_step(i, n, begin_N, released->part);
    contact = {.rigid = goes_on() ? Contact::Rigid::open : Contact::Rigid::over,
               .peak_N = contact.peak_N,
               .forgiven_m = contact.forgiven_m};
    contact_end_s_ = std::max(contact_end_s_, grid_.time_s(n - 1) + released->part * grid_.step_s);
  }

  [[nodiscard]] bool goes_on() const { return contacts_.after_contact == AfterContact::touch_again; }

  /// Laws that opened, and what to do when all contacts have ended.
  void settle(std::size_t n) {
    for (std::size_t i = 0; i < contacts_count(); ++i) {
      const ContactTrace& trace = recorder_.now[i];
      if (!state_.laws[i] || !trace.in_contact[n - 1] || trace.in_contact[n]) continue;
      const double before = trace.indentation_m[n - 1] - (trace.indentation_m[n] - state_.laws[i]->depth_m());
      const double part = before / (before - state_.laws[i]->depth_m());
      contact_end_s_ = std::max(contact_end_s_, grid_.time_s(n - 1) + grid_.step_s * part);
      if (!goes_on()) state_.laws[i]->open_for_good();
    }
    if (finished_) return;
    for (std::size_t i = 0; i < contacts_count(); ++i)
      if (!is_over(i)) return;
    finished_ = true;
    energy_error_ = energy_error(n);
    if (contacts_.after_contact == AfterContact::stop) grid_.size = std::min(grid_.size, n + 3);
  }

  /// With the bodies as they are now, at sample n.
  [[nodiscard]] double energy_error(std::size_t n) const {
    const double offered = recorder_.offered_J(n);
    if (offered == 0) return 0;
    double left = offered;
    for (const StrikingBody& body : bodies_.bodies) left -= body.received_work();
    for (const std::optional<LawContact>& law : state_.laws)
      if (law) left -= law->stored_J() + law->dissipated_J() + law->residual_J();
    return std::abs(left / offered);
  }

  const std::vector<ExplicitBody>& flights_;
  const ExplicitContacts& contacts_;
  UniformGrid grid_;
  JoinedBodies bodies_;
  ContactRecorder recorder_;
  RowState state_;  // without the bodies, which are in bodies_
  std::optional<ForceBisection> bisection_;
  std::array<RowState, 3> kept_;
  std::vector<Release> releases_;  // in the step to release_end_
  std::size_t release_end_ = 0;
  double speed_scale_ = 0;
  std::size_t trial_count_ = 0;
  bool held_start_ = false;
  bool finished_ = false;
  double contact_end_s_ = 0;
  double energy_error_ = 0;
};

}  // namespace

ExplicitContactsResult explicit_contacts(const std::vector<ExplicitBody>& bodies, const ExplicitContacts& contacts) {
  require_valid(bodies, contacts.step_s);
  return Run(bodies, contacts).result();
}

}  // namespace impulse
