#include "fem/explicit/row_march.hpp"

#include "fem/explicit/first_forces.hpp"
#include "lib/contract/require.hpp"
#include "lib/law/resolved_law.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {
namespace {

/// A force this small against the peak so far is rounding: it counts as none, so that it does not prolong a contact.
constexpr double no_force = 1e-9;

/// Likewise a speed and a distance against the largest speed of approach and its way in a step, for a contact that
/// closes.
constexpr double no_approach = 1e-9;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

void require_contacts(const JoinedBodies& bodies, const ExplicitContacts& asked) {
  const std::size_t count = bodies.contact_count();
  require(asked.laws.size() == count, "{} laws for {} contacts", asked.laws.size(), count);
  require(asked.gaps_m.size() == count, "{} gaps for {} contacts", asked.gaps_m.size(), count);
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    require(std::isfinite(asked.gaps_m[i]) && asked.gaps_m[i] >= 0, "gap {} m is negative", asked.gaps_m[i]);
    largest = std::max(largest, bodies.flight_speed(i));
  }
  require(largest > 0, "no body flies towards the next one, so they never meet");
  require(asked.matching == Matching::direct || (count == 1 && asked.laws[0].is_rigid()),
          "bisection finds the force of one rigid contact; use direct matching");
}

const Release* release_of(std::size_t contact, const std::vector<Release>& releases) {
  const auto found = std::ranges::find(releases, contact, &Release::contact);
  return found == releases.end() ? nullptr : &*found;
}

}  // namespace

RowMarch::RowMarch(const std::vector<ExplicitBody>& flights, const ExplicitContacts& asked, const UniformGrid& grid)
    : contacts{std::vector<RigidContact>(row_joints(flights).size()), {}},
      flights_(flights),
      asked_(asked),
      grid_(grid),
      bodies_(flights, asked.step_s),
      recorder_(bodies_, flights_, grid_) {
  require_contacts(bodies_, asked);
  for (std::size_t i = 0; i < bodies_.contact_count(); ++i) {
    speed_scale_ = std::max(speed_scale_, std::abs(bodies_.flight_speed(i)));
    contacts.laws.push_back(law_of(i));
    recorder_.now[i].indentation_m[0] = flight_m(i, 0);
  }
  if (asked.matching == Matching::bisection) bisection_.emplace(bodies_, asked.step_s);
}

/// With a residual flexibility a rigid contact is a spring.
std::optional<LawContact> RowMarch::law_of(std::size_t i) const {
  const double residual = bodies_.residual_flexibility()(index(i), index(i));
  if (!asked_.laws[i].is_rigid()) return LawContact(asked_.laws[i], residual, flight_m(i, 0));
  if (residual > 0) return LawContact(ContactLaw::linear(1 / residual), 0, flight_m(i, 0));
  return std::nullopt;
}

/// Indentation at sample n if the bodies flew on as before impact.
double RowMarch::flight_m(std::size_t i, std::size_t n) const {
  return bodies_.flight_speed(i) * grid_.time_s(n) - asked_.gaps_m[i];
}

void RowMarch::begin() {
  std::vector<std::size_t> touching;
  for (std::size_t i = 0; i < contacts.count(); ++i)
    if (!contacts.laws[i] && asked_.gaps_m[i] == 0 && bodies_.flight_speed(i) > 0) touching.push_back(i);
  if (asked_.start == ImpactStart::wave_admittance && !touching.empty()) return meet(0, touching);
  for (const std::size_t i : touching) {
    contacts.rigid[i].state = RigidContact::State::sticking;
    recorder_.now[i].in_contact[0] = true;
  }
}

void RowMarch::advance(std::size_t n, const std::vector<Release>& releases) {
  std::vector<double> power;
  for (const StrikingBody& body : bodies_.bodies) power.push_back(body.dashpot_power());
  std::vector<std::size_t> sticking;
  for (const std::size_t i : contacts.sticking())
    if (release_of(i, releases) == nullptr) sticking.push_back(i);
  const bool held = n == 1 && asked_.start == ImpactStart::held && !sticking.empty();
  const StepForce shape = held ? StepForce::held : StepForce::ramp;
  const StepForces forces = bisection_ && !sticking.empty() ? bisect(shape) : match(n, sticking, shape, releases);
  for (std::size_t b = 0; b < power.size(); ++b)
    bodies_.bodies[b].now.dissipated_J += 0.5 * grid_.step_s * (power[b] + bodies_.bodies[b].dashpot_power());
  recorder_.motion(n, forces.law_force_N);
  for (std::size_t i = 0; i < contacts.count(); ++i) {
    if (contacts.laws[i])
      record_law(i, n, forces.laws[i]);
    else if (std::ranges::find(sticking, i) != sticking.end())
      record_sticking(i, n, shape, forces.force_N[index(i)]);
    else
      record_open(i, n, releases);
  }
  close(n, releases);
}

StepForces RowMarch::bisect(StepForce shape) {
  const double begin = contacts.rigid[0].force_N;
  return {Eigen::VectorXd::Constant(1, bisection_->step(begin, shape) - begin), Eigen::VectorXd::Zero(1), {{}}};
}

/// Trial and correction.
StepForces RowMarch::match(std::size_t n, const std::vector<std::size_t>& sticking, StepForce shape,
                           const std::vector<Release>& releases) {
  ++trial_count_;
  std::vector<StepLoad> loads(contacts.count());
  for (std::size_t i = 0; i < contacts.count(); ++i) {
    if (contacts.laws[i]) bodies_.drop_force(i, contacts.laws[i]->mean_force_N());
    const double begin = contacts.rigid[i].force_N;
    if (contacts.rigid[i].sticks()) loads[i] = {begin, begin};
  }
  for (const Release& release : releases) loads[release.contact].zero_at = release.part;
  bodies_.integrate(loads);
  TrialStep trial{bodies_.closing_speed(), -bodies_.taken_back_m()};
  for (std::size_t i = 0; i < contacts.count(); ++i) trial.approach_m[index(i)] += flight_m(i, n);
  const StepForces forces = step_forces(bodies_, trial, sticking, shape, contacts.laws);
  apply(bodies_, forces, shape, contacts.laws);
  return forces;
}

/// Rigid contacts close at the sample nearest to where their faces meet.
void RowMarch::close(std::size_t n, const std::vector<Release>& releases) {
  const Eigen::VectorXd speed = bodies_.closing_speed(), taken_back = bodies_.taken_back_m();
  std::vector<std::size_t> closing;
  for (std::size_t i = 0; i < contacts.count(); ++i) {
    const RigidContact& contact = contacts.rigid[i];
    if (contacts.laws[i] || contact.state != RigidContact::State::open || release_of(i, releases) != nullptr) continue;
    if (speed[index(i)] <= no_approach * speed_scale_) continue;
    const double way = std::max(0.5 * speed[index(i)], no_approach * speed_scale_) * grid_.step_s;
    if (flight_m(i, n) - taken_back[index(i)] - contact.forgiven_m >= -way) closing.push_back(i);
  }
  if (!closing.empty()) meet(n, closing);
}

/// The force jumps on the sample to what brings the faces to one velocity. The record shows that of the continuous
/// bodies: the one that acts belongs to the faces' masses and grows as the step shrinks against the mesh.
void RowMarch::meet(std::size_t n, const std::vector<std::size_t>& closing) {
  const Eigen::VectorXd taken_back = bodies_.taken_back_m();
  const MeetingForces forces = meeting_forces(bodies_, closing, contacts.sticking(), grid_.step_s);
  const std::optional<Eigen::VectorXd>& known = forces.continuous_N;
  if (known) recorder_.jump(n, first_velocities(bodies_, *known));
  for (std::size_t i = 0; i < contacts.count(); ++i) {
    if (forces.acting_N[index(i)] == 0) continue;
    bodies_.drop_force(i, -forces.acting_N[index(i)]);
    contacts.rigid[i].force_N += forces.acting_N[index(i)];
  }
  for (const std::size_t i : closing) {
    RigidContact& contact = contacts.rigid[i];
    ContactTrace& trace = recorder_.now[i];
    contact.state = RigidContact::State::sticking;
    contact.met_at = n;
    contact.first_force = known ? RigidContact::FirstForce::known : RigidContact::FirstForce::as_next;
    contact.forgiven_m = flight_m(i, n) - taken_back[index(i)];
    trace.force_N[n] = known ? (*known)[index(i)] : 0;
    contact.peak_N = std::max(contact.peak_N, trace.force_N[n]);
    trace.indentation_m[n] = 0;
    trace.in_contact[n] = true;
  }
}

void RowMarch::record_law(std::size_t i, std::size_t n, const LawContact::Answer& answer) {
  LawContact& law = *contacts.laws[i];
  ContactTrace& trace = recorder_.now[i];
  law.accept(answer);
  recorder_.law_step(i, n, answer.mean_force_N);
  trace.force_N[n] = law.force_N();
  trace.indentation_m[n] = law.indentation_m();
  trace.in_contact[n] = law.in_contact();
  trace.stored_J[n] = law.stored_J();
  trace.dissipated_J[n] = law.dissipated_J();
  if (!asked_.laws[i].is_rigid())
    require_resolved_law(law.stiffness_ratio(bodies_.mobility(StepForce::held).displacement(index(i), index(i))), i + 1,
                         grid_.step_s);
}

void RowMarch::record_sticking(std::size_t i, std::size_t n, StepForce shape, double more_N) {
  RigidContact& contact = contacts.rigid[i];
  ContactTrace& trace = recorder_.now[i];
  double force = contact.force_N + more_N;
  const double begin_N = shape == StepForce::held ? force : contact.force_N;
  contact.peak_N = std::max(contact.peak_N, force);
  if (std::abs(force) <= no_force * contact.peak_N) force = 0;
  const bool first = contact.met_just_before(n) && contact.first_force == RigidContact::FirstForce::as_next;
  if (first || shape == StepForce::held) trace.force_N[n - 1] = force;
  trace.force_N[n] = contact.force_N = force;
  contact.forgiven_m = flight_m(i, n) - bodies_.taken_back_m()[index(i)];
  trace.indentation_m[n] = 0;
  trace.in_contact[n] = true;
  recorder_.rigid_step(i, n, begin_N, force);
}

void RowMarch::record_open(std::size_t i, std::size_t n, const std::vector<Release>& releases) {
  RigidContact& contact = contacts.rigid[i];
  ContactTrace& trace = recorder_.now[i];
  trace.force_N[n] = 0;
  trace.indentation_m[n] = flight_m(i, n) - bodies_.taken_back_m()[index(i)] - contact.forgiven_m;
  trace.in_contact[n] = false;
  const Release* released = release_of(i, releases);
  if (released == nullptr) {
    recorder_.rigid_step(i, n, 0, 0);
    return;
  }
  // A touch of one step: nothing but what the faces' masses exchanged.
  if (contact.met_just_before(n) && contact.first_force == RigidContact::FirstForce::as_next)
    trace.force_N[n - 1] = contact.force_N;
  recorder_.release_step(i, n, contact.force_N, released->part);
  const bool again = asked_.after_contact == AfterContact::touch_again;
  contact = {.state = again ? RigidContact::State::open : RigidContact::State::over,
             .peak_N = contact.peak_N,
             .forgiven_m = contact.forgiven_m};
}

void RowMarch::keep(RowState& state) const {
  state.bodies.resize(bodies_.bodies.size());
  for (std::size_t b = 0; b < state.bodies.size(); ++b) state.bodies[b] = bodies_.bodies[b].now;
  state.contacts = contacts;
}

void RowMarch::return_to(const RowState& state, std::size_t n) {
  bodies_.restore(state.bodies);
  contacts = state.contacts;
  for (ContactTrace& trace : recorder_.now)
    std::fill(trace.force_N.begin() + static_cast<std::ptrdiff_t>(n), trace.force_N.end(), 0.0);
}

double RowMarch::energy_error(std::size_t n) const {
  const double offered = recorder_.offered_J(n);
  if (offered == 0) return 0;
  double left = offered;
  for (const StrikingBody& body : bodies_.bodies) left -= body.received_work();
  for (const std::optional<LawContact>& law : contacts.laws)
    if (law) left -= law->stored_J() + law->dissipated_J() + law->residual_J();
  return std::abs(left / offered);
}

}  // namespace impulse
