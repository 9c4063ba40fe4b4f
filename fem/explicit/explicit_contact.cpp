#include "fem/explicit/explicit_contact.hpp"

#include "fem/explicit/contact_matching.hpp"
#include "fem/explicit/law_contact.hpp"
#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace impulse {
namespace {

/// A force this small against the peak so far is rounding: it counts as none, so that it does not prolong a contact.
constexpr double no_force = 1e-9;

/// Likewise a speed and a distance against the speed of approach and its way in a step, for a contact that closes.
constexpr double no_approach = 1e-9;

void require_body(const Structure& body, const char* name) {
  require(body.contacts.cols() == 1, "the {} has {} contacts; an explicit impact takes one", name,
          body.contacts.cols());
  require(body.contacts.rows() == body.mass.rows() && body.stiffness.rows() == body.mass.rows(),
          "stiffness, mass and contact of the {} disagree in size", name);
  require(body.contacts.col(0).sum() != 0, "the contact of the {} does not move when the body is shifted", name);
}

void require_free(const Structure& body, const char* name) {
  const Eigen::VectorXd flight_force = body.stiffness * Eigen::VectorXd::Ones(body.stiffness.rows());
  const Eigen::VectorXd diagonal = body.stiffness.diagonal();
  require(flight_force.cwiseAbs().maxCoeff() <= 1e-9 * diagonal.maxCoeff(),
          "the {} is held (moving it without strain is not possible); use a far end that is free or infinite", name);
}

void require_speeds(const ExplicitContact& contact) {
  const double first = contact.speed_m_per_s, second = contact.speed_2_m_per_s;
  require(std::isfinite(first) && (second != 0 || first > 0), "speed {} m/s is not positive", first);
  require(std::isfinite(second) && first > second,
          "the projectile's {} m/s do not exceed the target's {} m/s, so they never meet", first, second);
  require(std::isfinite(contact.gap_m) && contact.gap_m >= 0, "gap {} m is negative", contact.gap_m);
}

void require_valid(const Structure& projectile, const Structure& target, const ExplicitContact& contact) {
  require_speeds(contact);
  require(contact.projectile_subcycles >= 1,
          "0 subcycles of the projectile (it takes at least one step); use 1 or more");
  require_body(projectile, "projectile");
  require_body(target, "target");
  require_free(projectile, "projectile");
  if (contact.speed_2_m_per_s != 0) require_free(target, "target");
  require_stable_step(target, contact.step_s, "target");
  const double limit = stability_limit_s(projectile);
  const double step = contact.step_s / static_cast<double>(contact.projectile_subcycles);
  require(step <= limit * (1 + 1e-12),
          "projectile step {:.4g} us ({:.4g} us in {}) exceeds its stability limit {:.4g} us; use --subcycles {}",
          step * 1e6, contact.step_s * 1e6, contact.projectile_subcycles, limit * 1e6,
          std::ceil(contact.step_s / limit * (1 - 1e-12)));
}

/// H(0+) if it is known: that of the continuous body, or none of a rigid one.
std::optional<double> wave_admittance(const Structure& body) {
  const double known = body.wave_admittance.size() > 0 ? body.wave_admittance(0, 0) : 0;
  if (known > 0) return known;
  if (body.stiffness.nonZeros() == 0) return 0.0;
  return std::nullopt;
}

/// Drives the two bodies and records their contact sample by sample. Everything happens in the frame of the target
/// before impact; the record and the balances add its speed.
class Run {
 public:
  Run(const Structure& projectile, const Structure& target, const ExplicitContact& contact)
      : contact_(contact),
        grid_(grid_over(contact.duration_s, contact.step_s)),
        relative_{.speed_m_per_s = contact.speed_m_per_s - contact.speed_2_m_per_s,
                  .step_s = contact.step_s,
                  .projectile_subcycles = contact.projectile_subcycles,
                  .duration_s = contact.duration_s,
                  .matching = contact.matching,
                  .start = contact.start},
        bodies_(projectile, target, relative_),
        admittance_1_(wave_admittance(projectile)),
        admittance_2_(wave_admittance(target)) {
    if (!contact.law.is_rigid()) law_.emplace(bodies_.projectile, bodies_.target, contact.law, flight(0));
    for (std::vector<double>* column : columns()) column->assign(grid_.size, 0.0);
    trace_.in_contact.assign(grid_.size, false);
  }

  ExplicitContactResult result() {
    begin();
    for (std::size_t n = 1; n < grid_.size; ++n) {
      if (law_)
        press(n);
      else if (finished_)
        fly(n);
      else if (sticking_)
        n = stick(n);
      else
        approach(n);
    }
    // A contact that is over may have cut the record.
    for (std::vector<double>* column : columns()) column->resize(grid_.size);
    trace_.in_contact.resize(grid_.size);
    const bool in_contact = law_ ? law_->in_contact() : sticking_;
    if (in_contact) contact_end_s_ = grid_.duration_s();
    if (!finished_) energy_error_ = energy_error(grid_.size - 1);
    return {grid_,      std::move(trace_), balance_of_projectile(), balance_of_target(),
            in_contact, contact_end_s_,    energy_error_,           bodies_.trial_count()};
  }

 private:
  /// vᵀCv of both bodies when a step begins.
  struct DashpotPower {
    double first;
    double second;
  };

  [[nodiscard]] DashpotPower power() const {
    return {bodies_.projectile.dashpot_power(), bodies_.target.dashpot_power()};
  }

  std::vector<std::vector<double>*> columns() {
    return {&trace_.force_N,
            &trace_.running_impulse_Ns,
            &trace_.indentation_m,
            &trace_.stored_J,
            &trace_.dissipated_J,
            &trace_.velocity_1_m_per_s,
            &trace_.velocity_2_m_per_s,
            &trace_.displacement_1_m,
            &trace_.displacement_2_m,
            &trace_.work_1_J,
            &trace_.work_2_J};
  }

  void begin() {
    trace_.velocity_1_m_per_s[0] = contact_.speed_m_per_s;
    trace_.velocity_2_m_per_s[0] = contact_.speed_2_m_per_s;
    trace_.indentation_m[0] = flight(0);
    sticking_ = !law_ && contact_.gap_m == 0;
    trace_.in_contact[0] = sticking_;
    if (!sticking_) return;
    const double sum = admittance_1_.value_or(0) + admittance_2_.value_or(0);
    const bool known = admittance_1_ && admittance_2_ && sum > 0;
    held_start_ = contact_.start == ImpactStart::held || (contact_.start == ImpactStart::wave_admittance && !known);
    if (contact_.start != ImpactStart::wave_admittance || held_start_) return;
    const double force = relative_.speed_m_per_s / sum;
    bodies_.projectile.set_force(force);
    bodies_.target.set_force(force);
    trace_.force_N[0] = peak_ = force;
    trace_.velocity_1_m_per_s[0] -= *admittance_1_ * force;
    trace_.velocity_2_m_per_s[0] += *admittance_2_ * force;
  }

  /// A step with a law, in contact or not.
  void press(std::size_t n) {
    const DashpotPower before = power();
    const double force = law_->step(flight(n));
    record_motion(n, before);
    trace_.force_N[n] = law_->force_N();
    trace_.indentation_m[n] = law_->indentation_m();
    trace_.in_contact[n] = law_->in_contact();
    trace_.running_impulse_Ns[n] = trace_.running_impulse_Ns[n - 1] + force * grid_.step_s;
    trace_.work_1_J[n] = trace_.work_1_J[n - 1] - force * (trace_.displacement_1_m[n] - trace_.displacement_1_m[n - 1]);
    trace_.work_2_J[n] = trace_.work_2_J[n - 1] + force * (trace_.displacement_2_m[n] - trace_.displacement_2_m[n - 1]);
    trace_.stored_J[n] = law_->stored_J();
    trace_.dissipated_J[n] = law_->dissipated_J();
    const double depth = law_->depth_m();
    if (trace_.in_contact[n - 1] && !trace_.in_contact[n]) {
      contact_end_s_ = grid_.time_s(n - 1) + grid_.step_s * last_depth_m_ / (last_depth_m_ - depth);
      if (contact_.after_contact != AfterContact::touch_again) {
        law_->open_for_good();
        finish(n);
      }
    }
    last_depth_m_ = depth;
  }

  /// A step with the faces together; returns the sample reached, which is an earlier one where contact ends.
  std::size_t stick(std::size_t n) {
    std::vector<double>& force = trace_.force_N;
    if (force[n - 1] > 0) {
      last_projectile_ = bodies_.projectile.now;
      last_target_ = bodies_.target.now;
      last_forgiven_m_ = forgiven_m_;
    }
    const bool held = n == 1 && held_start_;
    const DashpotPower before = power();
    force[n] = bodies_.step(force[n - 1], held ? StepForce::held : StepForce::ramp);
    if (held) force[0] = force[1];
    record_motion(n, before);
    peak_ = std::max(peak_, force[n]);
    if (std::abs(force[n]) <= no_force * peak_) force[n] = 0;
    record_rigid(n);
    run_without_compression_ = force[n] <= 0 ? run_without_compression_ + 1 : 0;
    if (run_without_compression_ < patience()) return n;
    const std::size_t end = n + 1 - patience();
    release(end);
    return end;
  }

  /// Samples without compression that end a rigid contact.
  [[nodiscard]] std::size_t patience() const { return contact_.after_contact == AfterContact::touch_again ? 1 : 3; }

  /// From the last sample in compression to `end`, with a force that reaches zero on the way.
  void release(std::size_t end) {
    std::vector<double>& force = trace_.force_N;
    contact_end_s_ = contact_end_s(force, grid_, end);
    std::fill_n(force.begin() + static_cast<std::ptrdiff_t>(end), patience(), 0.0);
    bodies_.projectile.now = last_projectile_;
    bodies_.target.now = last_target_;
    forgiven_m_ = last_forgiven_m_;
    sticking_ = false;
    run_without_compression_ = 0;
    const double last = force[end - 1];
    const double since = contact_end_s_ - grid_.time_s(end - 1);
    const double part = since / grid_.step_s;
    const DashpotPower before = power();
    bodies_.projectile.integrate_release(last, part);
    bodies_.target.integrate_release(last, part);
    record_motion(end, before);
    trace_.indentation_m[end] = approach_m(end);
    trace_.in_contact[end] = false;
    const double impulse = 0.5 * last * since;
    trace_.running_impulse_Ns[end] = trace_.running_impulse_Ns[end - 1] + impulse;
    // The centre of the triangle is a third of the way down.
    const auto velocity = [&](const std::vector<double>& v) { return v[end - 1] + part / 3 * (v[end] - v[end - 1]); };
    trace_.work_1_J[end] = trace_.work_1_J[end - 1] - impulse * velocity(trace_.velocity_1_m_per_s);
    trace_.work_2_J[end] = trace_.work_2_J[end - 1] + impulse * velocity(trace_.velocity_2_m_per_s);
    if (contact_.after_contact != AfterContact::touch_again) finish(end);
  }

  /// A step without a force, unless the gap closes in it.
  void approach(std::size_t n) {
    const DashpotPower before = power();
    bodies_.projectile.integrate(0, 0);
    bodies_.target.integrate(0, 0);
    const double speed = relative_.speed_m_per_s;
    if (approach_m(n) >= -no_approach * speed * grid_.step_s && bodies_.closing_speed() > no_approach * speed) {
      trace_.force_N[n] = bodies_.close();
      peak_ = std::max(peak_, trace_.force_N[n]);
      sticking_ = true;
    }
    record_motion(n, before);
    record_rigid(n);
  }

  void fly(std::size_t n) {
    const DashpotPower before = power();
    bodies_.projectile.integrate(0, 0);
    bodies_.target.integrate(0, 0);
    record_motion(n, before);
    record_rigid(n);
  }

  /// The contact is over: the energies are compared here, before the dashpots' sums go on.
  void finish(std::size_t end) {
    finished_ = true;
    energy_error_ = energy_error(end);
    if (contact_.after_contact == AfterContact::stop) grid_.size = std::min(grid_.size, end + 3);
  }

  void record_motion(std::size_t n, const DashpotPower& before) {
    StrikingBody& first = bodies_.projectile;
    StrikingBody& second = bodies_.target;
    first.now.dissipated_J += 0.5 * grid_.step_s * (before.first + first.dashpot_power());
    second.now.dissipated_J += 0.5 * grid_.step_s * (before.second + second.dashpot_power());
    trace_.velocity_1_m_per_s[n] = contact_.speed_m_per_s - first.face_velocity();
    trace_.velocity_2_m_per_s[n] = contact_.speed_2_m_per_s + second.face_velocity();
    trace_.displacement_1_m[n] = contact_.speed_m_per_s * grid_.time_s(n) - first.face_displacement();
    trace_.displacement_2_m[n] = contact_.speed_2_m_per_s * grid_.time_s(n) + second.face_displacement();
  }

  void record_rigid(std::size_t n) {
    if (sticking_) forgiven_m_ += approach_m(n);
    trace_.in_contact[n] = sticking_;
    trace_.indentation_m[n] = sticking_ ? 0 : approach_m(n);
    const std::vector<double>& f = trace_.force_N;
    const auto work = [&](const std::vector<double>& v) {
      return 0.5 * grid_.step_s * (f[n - 1] * v[n - 1] + f[n] * v[n]);
    };
    trace_.running_impulse_Ns[n] = trace_.running_impulse_Ns[n - 1] + 0.5 * grid_.step_s * (f[n - 1] + f[n]);
    trace_.work_1_J[n] = trace_.work_1_J[n - 1] - work(trace_.velocity_1_m_per_s);
    trace_.work_2_J[n] = trace_.work_2_J[n - 1] + work(trace_.velocity_2_m_per_s);
  }

  /// Indentation at sample n if the bodies flew on as before impact.
  [[nodiscard]] double flight(std::size_t n) const {
    return relative_.speed_m_per_s * grid_.time_s(n) - contact_.gap_m;
  }

  [[nodiscard]] double approach_m(std::size_t n) const {
    return flight(n) - bodies_.projectile.face_displacement() - bodies_.target.face_displacement() - forgiven_m_;
  }

  /// With the bodies as they are now, at sample n.
  [[nodiscard]] double energy_error(std::size_t n) const {
    const double offered = relative_.speed_m_per_s * trace_.running_impulse_Ns[n];
    if (offered == 0) return 0;
    const double contact = law_ ? law_->stored_J() + law_->dissipated_J() : 0;
    return std::abs(offered - bodies_.projectile.received_work() - bodies_.target.received_work() - contact) / offered;
  }

  /// The departure on top of a flight, along which it counts with the sign `along`.
  static BodyBalance balance(const StrikingBody& body, double speed, double along) {
    const double momentum = along * body.momentum();
    const double kinetic = body.kinetic_energy() + (0.5 * body.mass_kg() * speed * speed + speed * momentum);
    return {body.mass_kg() * speed + momentum,
            kinetic,
            body.strain_energy(),
            body.now.dissipated_J,
            body.step_s(),
            body.step_count()};
  }

  /// Its translation is against the functional.
  [[nodiscard]] BodyBalance balance_of_projectile() const {
    return balance(bodies_.projectile, contact_.speed_m_per_s, -1);
  }
  [[nodiscard]] BodyBalance balance_of_target() const { return balance(bodies_.target, contact_.speed_2_m_per_s, 1); }

  const ExplicitContact& contact_;
  UniformGrid grid_;
  ExplicitImpact relative_;
  ContactMatching bodies_;
  std::optional<LawContact> law_;
  std::optional<double> admittance_1_;
  std::optional<double> admittance_2_;
  ContactTrace trace_;
  bool held_start_ = false;
  bool sticking_ = false;
  bool finished_ = false;
  std::size_t run_without_compression_ = 0;
  double peak_ = 0;
  double last_depth_m_ = 0;
  double forgiven_m_ = 0;
  double last_forgiven_m_ = 0;
  double contact_end_s_ = 0;
  double energy_error_ = 0;
  Snapshot last_projectile_;
  Snapshot last_target_;
};

}  // namespace

ExplicitContactResult explicit_contact(const Structure& projectile, const Structure& target,
                                       const ExplicitContact& contact) {
  require_valid(projectile, target, contact);
  return Run(projectile, target, contact).result();
}

}  // namespace impulse
