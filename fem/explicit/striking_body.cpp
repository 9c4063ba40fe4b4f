#include "fem/explicit/striking_body.hpp"

#include <algorithm>

namespace impulse {

StrikingBody::StrikingBody(const Structure& body, double step_s, std::size_t subcycles)
    : now{MotionState::at_rest(body.mass.rows()), 0},
      structure_(body),
      contacts_(body.contacts.sparseView()),
      acceleration_per_force_(body.contacts),
      stepper_(body, step_s / static_cast<double>(subcycles)),
      subcycles_(subcycles),
      load_(Eigen::VectorXd::Zero(body.mass.rows())),
      forces_(Eigen::VectorXd::Zero(body.contacts.cols())) {
  const MassSolver mass(body.mass);
  for (Eigen::Index k = 0; k < contact_count(); ++k) acceleration_per_force_.col(k) = mass.solved(body.contacts.col(k));
}

void StrikingBody::fill_load(const Eigen::VectorXd& forces) {
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
  for (Eigen::Index k = 0; k < contact_count(); ++k)
    for (Entry entry(contacts_, k); entry; ++entry) load_[entry.row()] = 0;
  for (Eigen::Index k = 0; k < contact_count(); ++k)
    for (Entry entry(contacts_, k); entry; ++entry) load_[entry.row()] += entry.value() * forces[k];
}

void StrikingBody::set_forces(const Eigen::VectorXd& forces) {
  fill_load(forces);
  stepper_.set_load(now.motion, load_);
}

double StrikingBody::release_sample(const StepLoad& load, std::size_t substep) const {
  const double n = static_cast<double>(subcycles_);
  const auto triangle = [&](std::size_t j) { return std::max(0.0, 1 - static_cast<double>(j) / (n * *load.zero_at)); };
  double sum = 0.5;
  for (std::size_t j = 1; j <= subcycles_; ++j) sum += triangle(j);
  return load.begin_N * 0.5 * n * *load.zero_at / sum * (substep == 0 ? 1 : triangle(substep));
}

void StrikingBody::integrate(const std::vector<StepLoad>& loads) {
  for (std::size_t k = 0; k < loads.size(); ++k)
    if (loads[k].zero_at) drop_force(static_cast<Eigen::Index>(k), loads[k].begin_N - release_sample(loads[k], 0));
  for (std::size_t j = 1; j <= subcycles_; ++j) {
    const double part = static_cast<double>(j) / static_cast<double>(subcycles_);
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const StepLoad& load = loads[k];
      forces_[static_cast<Eigen::Index>(k)] =
          load.zero_at ? release_sample(load, j) : load.begin_N + (load.end_N - load.begin_N) * part;
    }
    fill_load(forces_);
    stepper_.advance(now.motion, load_);
  }
  step_count_ += subcycles_;
}

double StrikingBody::dashpot_power() const {
  if (structure_.dashpots.size() == 0) return 0;
  return now.motion.velocity.cwiseAbs2().dot(structure_.dashpots);
}

double StrikingBody::kinetic_energy() const {
  const Eigen::VectorXd momentum = structure_.mass * now.motion.velocity;
  return 0.5 * momentum.dot(now.motion.velocity);
}

double StrikingBody::strain_energy() const {
  const Eigen::VectorXd force = structure_.stiffness * now.motion.displacement;
  return 0.5 * force.dot(now.motion.displacement);
}

double StrikingBody::momentum(const Eigen::VectorXd& translation) const {
  const Eigen::VectorXd momentum = structure_.mass * now.motion.velocity;
  return translation.dot(momentum);
}

double StrikingBody::received_work() const {
  const double step = step_s();
  const Eigen::VectorXd inertia = structure_.mass * now.motion.acceleration;
  return kinetic_energy() + strain_energy() - step * step / 8 * inertia.dot(now.motion.acceleration) + now.dissipated_J;
}

UnitResponse::UnitResponse(const StrikingBody& body, Eigen::Index contact, double begin_force) {
  StrikingBody rested = body;
  rested.now.motion = MotionState::at_rest(body.now.motion.velocity.size());
  rested.set_forces(begin_force * Eigen::VectorXd::Unit(body.contact_count(), contact));
  std::vector<StepLoad> loads(static_cast<std::size_t>(body.contact_count()));
  loads[static_cast<std::size_t>(contact)] = {begin_force, 1};
  rested.integrate(loads);
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
