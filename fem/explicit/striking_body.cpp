#include "fem/explicit/striking_body.hpp"

#include <algorithm>

namespace impulse {

StrikingBody::StrikingBody(const Structure& body, double step_s, std::size_t subcycles)
    : now{MotionState::at_rest(body.mass.rows()), 0},
      structure_(body),
      contact_(body.contacts.col(0)),
      mass_(lumped_mass(body)),
      face_acceleration_(contact_.cwiseQuotient(mass_)),
      stepper_(body, step_s / static_cast<double>(subcycles)),
      subcycles_(subcycles) {}

void StrikingBody::integrate(double begin_force, double end_force) {
  for (std::size_t j = 1; j <= subcycles_; ++j) {
    const double part = static_cast<double>(j) / static_cast<double>(subcycles_);
    stepper_.advance(now.motion, contact_, begin_force + (end_force - begin_force) * part);
  }
  step_count_ += subcycles_;
}

void StrikingBody::integrate_release(double force, double part) {
  const double n = static_cast<double>(subcycles_);
  const auto sample = [&](std::size_t j) { return std::max(0.0, 1 - static_cast<double>(j) / (n * part)); };
  double sum = 0.5;
  for (std::size_t j = 1; j <= subcycles_; ++j) sum += sample(j);
  const double scaled = force * 0.5 * n * part / sum;
  set_force(scaled);
  for (std::size_t j = 1; j <= subcycles_; ++j) stepper_.advance(now.motion, contact_, scaled * sample(j));
  step_count_ += subcycles_;
}

double StrikingBody::dashpot_power() const {
  if (structure_.dashpots.size() == 0) return 0;
  return now.motion.velocity.cwiseAbs2().dot(structure_.dashpots);
}

double StrikingBody::strain_energy() const {
  const Eigen::VectorXd force = structure_.stiffness * now.motion.displacement;
  return 0.5 * force.dot(now.motion.displacement);
}

double StrikingBody::received_work() const {
  const double step = step_s();
  const double curvature = mass_.dot(now.motion.acceleration.cwiseAbs2());
  return kinetic_energy() + strain_energy() - step * step / 8 * curvature + now.dissipated_J;
}

UnitResponse::UnitResponse(const StrikingBody& body, double begin_force) {
  StrikingBody rested = body;
  rested.now.motion = MotionState::at_rest(body.now.motion.velocity.size());
  rested.set_force(begin_force);
  rested.integrate(begin_force, 1);
  const MotionState& motion = rested.now.motion;
  first_ = motion.velocity.size();
  Eigen::Index last = -1;
  for (Eigen::Index i = 0; i < motion.velocity.size(); ++i) {
    if (motion.displacement[i] == 0 && motion.velocity[i] == 0 && motion.acceleration[i] == 0) continue;
    first_ = std::min(first_, i);
    last = i;
  }
  const Eigen::Index count = last + 1 - first_;
  motion_ = {motion.displacement.segment(first_, count), motion.velocity.segment(first_, count),
             motion.acceleration.segment(first_, count)};
  face_velocity_ = rested.face_velocity();
  face_displacement_ = rested.face_displacement();
}

void UnitResponse::add_to(StrikingBody& body, double force) const {
  const Eigen::Index count = motion_.velocity.size();
  MotionState& motion = body.now.motion;
  motion.displacement.segment(first_, count) += force * motion_.displacement;
  motion.velocity.segment(first_, count) += force * motion_.velocity;
  motion.acceleration.segment(first_, count) += force * motion_.acceleration;
}

}  // namespace impulse
