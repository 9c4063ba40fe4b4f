#include "fem/explicit/first_forces.hpp"

#include "fem/explicit/step_forces.hpp"

namespace impulse {
namespace {

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// Velocity of a body's contact under a unit force on contact j of the row; unknown admittances count as none.
double admittance(const JoinedBodies& bodies, std::size_t body, Eigen::Index contact, std::size_t j) {
  const std::optional<Eigen::MatrixXd> own = known_wave_admittance(bodies.bodies[body].structure());
  if (!own) return 0;
  const RowJoint& joint = bodies.joint(j);
  return (joint.body_1 == body ? (*own)(contact, joint.contact_1) : 0) +
         (joint.body_2 == body ? (*own)(contact, joint.contact_2) : 0);
}

double joint_admittance(const JoinedBodies& bodies, std::size_t i, std::size_t j) {
  const RowJoint& joint = bodies.joint(i);
  return admittance(bodies, joint.body_1, joint.contact_1, j) + admittance(bodies, joint.body_2, joint.contact_2, j);
}

}  // namespace

bool has_wave_admittance(const JoinedBodies& bodies, std::size_t contact) {
  const RowJoint& joint = bodies.joint(contact);
  return known_wave_admittance(bodies.bodies[joint.body_1].structure()) &&
         known_wave_admittance(bodies.bodies[joint.body_2].structure()) &&
         joint_admittance(bodies, contact, contact) > 0;
}

std::optional<Eigen::VectorXd> first_forces(const JoinedBodies& bodies, const std::vector<std::size_t>& closing,
                                            const Eigen::VectorXd& speed) {
  const Eigen::Index p = index(closing.size());
  Eigen::MatrixXd matrix(p, p);
  Eigen::VectorXd v(p);
  for (Eigen::Index k = 0; k < p; ++k) {
    const std::size_t i = closing[static_cast<std::size_t>(k)];
    if (!has_wave_admittance(bodies, i)) return std::nullopt;
    v[k] = speed[index(i)];
    for (Eigen::Index l = 0; l < p; ++l)
      matrix(k, l) = joint_admittance(bodies, i, closing[static_cast<std::size_t>(l)]);
  }
  const Eigen::VectorXd solved = matrix.partialPivLu().solve(v);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(speed.size());
  for (Eigen::Index k = 0; k < p; ++k) forces[index(closing[static_cast<std::size_t>(k)])] = solved[k];
  return forces;
}

MeetingForces meeting_forces(const JoinedBodies& bodies, const std::vector<std::size_t>& closing,
                             const std::vector<std::size_t>& sticking, double step_s) {
  const Eigen::VectorXd speed = bodies.closing_speed();
  MeetingForces forces{{}, first_forces(bodies, closing, speed)};
  std::vector<std::size_t> held = closing;
  held.insert(held.end(), sticking.begin(), sticking.end());
  const TrialStep apart{speed + 0.5 * step_s * bodies.closing_acceleration(), Eigen::VectorXd::Zero(speed.size())};
  const std::vector<std::optional<LawContact>> no_laws(bodies.contact_count());
  forces.acting_N = step_forces(bodies, apart, held, StepForce::ramp, no_laws).force_N;
  return forces;
}

Eigen::MatrixX2d first_velocities(const JoinedBodies& bodies, const Eigen::VectorXd& forces) {
  Eigen::MatrixX2d velocities = Eigen::MatrixX2d::Zero(forces.size(), 2);
  for (std::size_t i = 0; i < bodies.contact_count(); ++i) {
    const RowJoint& joint = bodies.joint(i);
    for (std::size_t j = 0; j < bodies.contact_count(); ++j) {
      const double force = forces[index(j)];
      if (force == 0) continue;
      velocities(index(i), 0) += force * admittance(bodies, joint.body_1, joint.contact_1, j);
      velocities(index(i), 1) += force * admittance(bodies, joint.body_2, joint.contact_2, j);
    }
  }
  return velocities;
}

}  // namespace impulse
