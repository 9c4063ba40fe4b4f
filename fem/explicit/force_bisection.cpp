#include "fem/explicit/force_bisection.hpp"

#include "lib/numerics/roots.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace impulse {

ForceBisection::ForceBisection(JoinedBodies& bodies, double step_s)
    : bodies_(bodies),
      force_scale_(bodies.flight_speed(0) / (0.5 * step_s * bodies.face_mobility(0))),
      increment_(force_scale_) {}

double ForceBisection::step(double begin_force, StepForce shape) {
  const std::vector<Snapshot> before = bodies_.state();
  const auto trial = [&](double increment) {
    ++trial_count_;
    bodies_.restore(before);
    const double end_force = begin_force + increment;
    if (shape == StepForce::held) bodies_.set_forces(Eigen::VectorXd::Constant(1, end_force));
    bodies_.integrate({{shape == StepForce::held ? end_force : begin_force, end_force}});
    return bodies_.closing_speed()[0];
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
