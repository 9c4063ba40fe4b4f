#include "fem/explicit/explicit_impact.hpp"

#include "fem/explicit/contact_matching.hpp"
#include "lib/contract/require.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {
namespace {

/// A force this small against the peak so far is rounding: it counts as none, so that it does not prolong a contact.
constexpr double no_force = 1e-9;

void require_body(const Structure& body, const char* name) {
  require(body.contacts.cols() == 1, "the {} has {} contacts; an explicit impact takes one", name,
          body.contacts.cols());
  require(body.contacts.rows() == body.mass.rows() && body.stiffness.rows() == body.mass.rows(),
          "stiffness, mass and contact of the {} disagree in size", name);
  require(body.contacts.col(0).sum() != 0, "the contact of the {} does not move when the body is shifted", name);
}

void require_valid(const Structure& projectile, const Structure& target, const ExplicitImpact& impact) {
  require(std::isfinite(impact.speed_m_per_s) && impact.speed_m_per_s > 0, "speed {} m/s is not positive",
          impact.speed_m_per_s);
  require(impact.projectile_subcycles >= 1,
          "0 subcycles of the projectile (it takes at least one step); use 1 or more");
  require_body(projectile, "projectile");
  require_body(target, "target");
  const Eigen::VectorXd flight_force = projectile.stiffness * Eigen::VectorXd::Ones(projectile.stiffness.rows());
  require(flight_force.cwiseAbs().maxCoeff() <= 1e-9 * projectile.stiffness.diagonal().maxCoeff(),
          "the projectile is held (moving it without strain is not possible); use a far end that is free or infinite");
  require_stable_step(target, impact.step_s, "target");
  const double limit = stability_limit_s(projectile);
  const double step = impact.step_s / static_cast<double>(impact.projectile_subcycles);
  require(step <= limit * (1 + 1e-12),
          "projectile step {:.4g} us ({:.4g} us in {}) exceeds its stability limit {:.4g} us; use --subcycles {}",
          step * 1e6, impact.step_s * 1e6, impact.projectile_subcycles, limit * 1e6,
          std::ceil(impact.step_s / limit * (1 - 1e-12)));
}

/// Records an impact sample by sample while it drives the two bodies.
class Run {
 public:
  Run(const Structure& projectile, const Structure& target, const ExplicitImpact& impact)
      : impact_(impact),
        bodies_(projectile, target, impact),
        wave_admittance_1_(projectile.wave_admittance.size() > 0 ? projectile.wave_admittance(0, 0) : 0),
        wave_admittance_2_(target.wave_admittance.size() > 0 ? target.wave_admittance(0, 0) : 0) {
    history_.grid = grid_over(impact.duration_s, impact.step_s);
    history_.force_N.assign(history_.grid.size, 0.0);
    history_.velocity_1_m_per_s.assign(history_.grid.size, 0.0);
    history_.velocity_2_m_per_s.assign(history_.grid.size, 0.0);
  }

  ExplicitImpactResult result() {
    begin();
    const std::size_t end = stay_in_contact();
    history_.contact_end_s = contact_end_s(history_.force_N, history_.grid, end);
    history_.separated = end < history_.grid.size;
    if (history_.separated) release(end);
    history_.energy_error = energy_error();
    if (history_.separated) fly_on(end);
    return {history_, balance_of_projectile(), balance(bodies_.target), bodies_.trial_count()};
  }

 private:
  void begin() {
    const bool admittance_known = wave_admittance_1_ > 0 && wave_admittance_2_ > 0;
    held_start_ =
        impact_.start == ImpactStart::held || (impact_.start == ImpactStart::wave_admittance && !admittance_known);
    history_.velocity_1_m_per_s[0] = impact_.speed_m_per_s;
    if (impact_.start != ImpactStart::wave_admittance || held_start_) return;
    const double force = impact_.speed_m_per_s / (wave_admittance_1_ + wave_admittance_2_);
    bodies_.projectile.set_force(force);
    bodies_.target.set_force(force);
    history_.force_N[0] = force;
    history_.velocity_1_m_per_s[0] -= wave_admittance_1_ * force;
    history_.velocity_2_m_per_s[0] = wave_admittance_2_ * force;
  }

  /// Returns contact_end_index of the force, and keeps the bodies' motion at the last sample in compression.
  std::size_t stay_in_contact() {
    std::vector<double>& force = history_.force_N;
    double peak = force[0];
    std::size_t run_without_compression = 0;
    for (std::size_t n = 1; n < force.size(); ++n) {
      if (force[n - 1] > 0) {
        last_projectile_ = bodies_.projectile.now;
        last_target_ = bodies_.target.now;
      }
      const bool held = n == 1 && held_start_;
      const double power_before_1 = bodies_.projectile.dashpot_power();
      const double power_before_2 = bodies_.target.dashpot_power();
      force[n] = bodies_.step(force[n - 1], held ? StepForce::held : StepForce::ramp);
      if (held) force[0] = force[1];
      record(n, power_before_1, power_before_2);
      peak = std::max(peak, force[n]);
      if (std::abs(force[n]) <= no_force * peak) force[n] = 0;
      run_without_compression = force[n] <= 0 ? run_without_compression + 1 : 0;
      if (run_without_compression == 3) return n - 2;
    }
    return force.size();
  }

  /// From the last sample in compression to `end`, with a force that reaches zero at contact_end_s.
  void release(std::size_t end) {
    bodies_.projectile.now = last_projectile_;
    bodies_.target.now = last_target_;
    const double force = history_.force_N[end - 1];
    const double part = (history_.contact_end_s - history_.grid.time_s(end - 1)) / history_.grid.step_s;
    const double power_before_1 = bodies_.projectile.dashpot_power();
    const double power_before_2 = bodies_.target.dashpot_power();
    bodies_.projectile.integrate_release(force, part);
    bodies_.target.integrate_release(force, part);
    record(end, power_before_1, power_before_2);
  }

  void fly_on(std::size_t end) {
    std::size_t size = history_.grid.size;
    if (impact_.after_contact == AfterContact::stop) size = std::min(size, end + 3);
    history_.grid.size = size;
    history_.force_N.resize(size);
    history_.velocity_1_m_per_s.resize(size);
    history_.velocity_2_m_per_s.resize(size);
    std::fill(history_.force_N.begin() + static_cast<std::ptrdiff_t>(end), history_.force_N.end(), 0.0);
    for (std::size_t n = end + 1; n < size; ++n) {
      const double power_before_1 = bodies_.projectile.dashpot_power();
      const double power_before_2 = bodies_.target.dashpot_power();
      bodies_.projectile.integrate(0, 0);
      bodies_.target.integrate(0, 0);
      record(n, power_before_1, power_before_2);
    }
  }

  void record(std::size_t n, double power_before_1, double power_before_2) {
    StrikingBody& first = bodies_.projectile;
    StrikingBody& second = bodies_.target;
    first.now.dissipated_J += 0.5 * impact_.step_s * (power_before_1 + first.dashpot_power());
    second.now.dissipated_J += 0.5 * impact_.step_s * (power_before_2 + second.dashpot_power());
    history_.velocity_1_m_per_s[n] = impact_.speed_m_per_s - first.face_velocity();
    history_.velocity_2_m_per_s[n] = second.face_velocity();
  }

  [[nodiscard]] double energy_error() const {
    const double offered = impact_.speed_m_per_s * impulse_Ns(history_);
    return std::abs(offered - bodies_.projectile.received_work() - bodies_.target.received_work()) / offered;
  }

  static BodyBalance balance(const StrikingBody& body) {
    return {body.momentum(),       body.kinetic_energy(), body.strain_energy(),
            body.now.dissipated_J, body.step_s(),         body.step_count()};
  }

  /// The departure on top of the flight with V, whose translation is against the functional.
  [[nodiscard]] BodyBalance balance_of_projectile() const {
    const StrikingBody& body = bodies_.projectile;
    const double speed = impact_.speed_m_per_s;
    BodyBalance sum = balance(body);
    sum.kinetic_energy_J += 0.5 * body.mass_kg() * speed * speed - speed * sum.momentum_Ns;
    sum.momentum_Ns = body.mass_kg() * speed - sum.momentum_Ns;
    return sum;
  }

  const ExplicitImpact& impact_;
  ContactMatching bodies_;
  double wave_admittance_1_;
  double wave_admittance_2_;
  bool held_start_ = false;
  ImpactHistory history_;
  Snapshot last_projectile_;
  Snapshot last_target_;
};

}  // namespace

ExplicitImpactResult explicit_impact(const Structure& projectile, const Structure& target,
                                     const ExplicitImpact& impact) {
  require_valid(projectile, target, impact);
  return Run(projectile, target, impact).result();
}

}  // namespace impulse
