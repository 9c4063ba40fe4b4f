#include "fem/explicit/contact_matching.hpp"

#include "lib/numerics/roots.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace impulse {

ContactMatching::ContactMatching(const Structure& projectile_structure, const Structure& target_structure,
                                 const ExplicitImpact& impact)
    : projectile(projectile_structure, impact.step_s, impact.projectile_subcycles),
      target(target_structure, impact.step_s, 1),
      impact_(impact),
      ramp_1_(projectile, 0),
      ramp_2_(target, 0),
      force_scale_(impact.speed_m_per_s /
                   (0.5 * impact.step_s * (projectile.face_mobility() + target.face_mobility()))),
      increment_(force_scale_),
      before_1_(projectile.now),
      before_2_(target.now) {}

double ContactMatching::step(double begin_force, StepForce shape) {
  return impact_.matching == Matching::direct ? step_directly(begin_force, shape)
                                              : step_by_bisection(begin_force, shape);
}

double ContactMatching::close() { return correct(0, ramp_1_, ramp_2_); }

void ContactMatching::integrate(double begin_force, double end_force) {
  projectile.integrate(begin_force, end_force);
  target.integrate(begin_force, end_force);
}

double ContactMatching::closing_speed() const {
  return impact_.speed_m_per_s - projectile.face_velocity() - target.face_velocity();
}

double ContactMatching::correct(double trial_force, const UnitResponse& unit_1, const UnitResponse& unit_2) {
  const double more = closing_speed() / (unit_1.face_velocity() + unit_2.face_velocity());
  unit_1.add_to(projectile, more);
  unit_2.add_to(target, more);
  return trial_force + more;
}

double ContactMatching::step_directly(double begin_force, StepForce shape) {
  ++trial_count_;
  if (shape == StepForce::held) {
    integrate(0, 0);
    return correct(0, UnitResponse(projectile, 1), UnitResponse(target, 1));
  }
  integrate(begin_force, begin_force);
  return correct(begin_force, ramp_1_, ramp_2_);
}

double ContactMatching::step_by_bisection(double begin_force, StepForce shape) {
  before_1_ = projectile.now;
  before_2_ = target.now;
  const auto trial = [&](double increment) {
    ++trial_count_;
    projectile.now = before_1_;
    target.now = before_2_;
    const double end_force = begin_force + increment;
    if (shape == StepForce::held) {
      projectile.set_force(end_force);
      target.set_force(end_force);
    }
    integrate(shape == StepForce::held ? end_force : begin_force, end_force);
    return closing_speed();
  };
  // The closing speed falls as the force grows: widen until it changes sign, starting from twice the last increment.
  double high = std::max(2 * std::abs(increment_), 1e-6 * force_scale_);
  double low = -high;
  while (trial(high) > 0) high *= 2;
  while (trial(low) < 0) low *= 2;
  increment_ = bisected_root(std::ref(trial), low, high, {1e-12 * force_scale_, 1e-14, 200});
  trial(increment_);
  return begin_force + increment_;
}

}  // namespace impulse
