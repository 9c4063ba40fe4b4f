#include "fem/explicit/joined_bodies.hpp"

namespace impulse {
namespace {

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

JoinedBodies::JoinedBodies(const std::vector<ExplicitBody>& all, double step_s) : joints_(row_joints(all)) {
  for (const ExplicitBody& body : all) {
    bodies.emplace_back(body.structure, step_s, body.subcycles);
    speeds_.push_back(body.speed_m_per_s);
    joint_of_.emplace_back(static_cast<std::size_t>(body.structure.contacts.cols()));
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const RowJoint& joint = joints_[i];
    joint_of_[joint.body_1][static_cast<std::size_t>(joint.contact_1)] = i;
    joint_of_[joint.body_2][static_cast<std::size_t>(joint.contact_2)] = i;
  }
  for (const RowJoint& joint : joints_)
    for (const double begin : {0.0, 1.0})
      (begin == 0 ? ramps_ : helds_)
          .push_back({UnitResponse(bodies[joint.body_1], joint.contact_1, begin),
                      UnitResponse(bodies[joint.body_2], joint.contact_2, begin)});
  ramp_ = mobility_of(ramps_);
  held_ = mobility_of(helds_);
  find_residual();
}

StepMobility JoinedBodies::mobility_of(const std::vector<Pair>& responses) const {
  const Eigen::Index p = index(joints_.size());
  StepMobility mobility{Eigen::MatrixXd::Zero(p, p), Eigen::MatrixXd::Zero(p, p)};
  const auto add = [&](std::size_t body, const UnitResponse& response, std::size_t column) {
    for (std::size_t k = 0; k < joint_of_[body].size(); ++k) {
      const Eigen::Index row = index(joint_of_[body][k]);
      mobility.velocity(row, index(column)) += response.face_velocity()[index(k)];
      mobility.displacement(row, index(column)) += response.face_displacement()[index(k)];
    }
  };
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    add(joints_[j].body_1, responses[j].side_1, j);
    add(joints_[j].body_2, responses[j].side_2, j);
  }
  return mobility;
}

void JoinedBodies::find_residual() {
  residual_ = Eigen::MatrixXd::Zero(index(joints_.size()), index(joints_.size()));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Eigen::MatrixXd& own = bodies[b].structure().residual_flexibility;
    if (own.size() == 0) continue;
    for (std::size_t k = 0; k < joint_of_[b].size(); ++k)
      for (std::size_t l = 0; l < joint_of_[b].size(); ++l)
        residual_(index(joint_of_[b][k]), index(joint_of_[b][l])) += own(index(k), index(l));
  }
}

double JoinedBodies::flight_speed(std::size_t contact) const {
  return speeds_[joints_[contact].body_1] - speeds_[joints_[contact].body_2];
}

Eigen::VectorXd JoinedBodies::sum_of_faces(Eigen::VectorXd (StrikingBody::*motion)() const) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(index(joints_.size()));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Eigen::VectorXd own = (bodies[b].*motion)();
    for (std::size_t k = 0; k < joint_of_[b].size(); ++k) sum[index(joint_of_[b][k])] += own[index(k)];
  }
  return sum;
}

Eigen::VectorXd JoinedBodies::closing_speed() const {
  Eigen::VectorXd speed(index(joints_.size()));
  for (std::size_t i = 0; i < joints_.size(); ++i) speed[index(i)] = flight_speed(i);
  speed -= sum_of_faces(&StrikingBody::face_velocity);
  return speed;
}

Eigen::VectorXd JoinedBodies::closing_acceleration() const { return -sum_of_faces(&StrikingBody::face_acceleration); }

Eigen::VectorXd JoinedBodies::taken_back_m() const { return sum_of_faces(&StrikingBody::face_displacement); }

void JoinedBodies::integrate(const std::vector<StepLoad>& loads) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    body_loads_.clear();
    for (const std::size_t i : joint_of_[b]) body_loads_.push_back(loads[i]);
    bodies[b].integrate(body_loads_);
  }
}

void JoinedBodies::set_forces(const Eigen::VectorXd& forces) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Eigen::VectorXd own(index(joint_of_[b].size()));
    for (std::size_t k = 0; k < joint_of_[b].size(); ++k) own[index(k)] = forces[index(joint_of_[b][k])];
    bodies[b].set_forces(own);
  }
}

void JoinedBodies::drop_force(std::size_t contact, double force) {
  const RowJoint& joint = joints_[contact];
  bodies[joint.body_1].drop_force(joint.contact_1, force);
  bodies[joint.body_2].drop_force(joint.contact_2, force);
}

void JoinedBodies::add(std::size_t contact, StepForce shape, double force) {
  const RowJoint& joint = joints_[contact];
  const Pair& response = (shape == StepForce::ramp ? ramps_ : helds_)[contact];
  response.side_1.add_to(bodies[joint.body_1], force);
  response.side_2.add_to(bodies[joint.body_2], force);
}

double JoinedBodies::face_mobility(std::size_t contact) const {
  const RowJoint& joint = joints_[contact];
  return bodies[joint.body_1].face_mobility(joint.contact_1) + bodies[joint.body_2].face_mobility(joint.contact_2);
}

double JoinedBodies::face_displacement(std::size_t body, Eigen::Index contact, const Eigen::VectorXd& forces) const {
  double displacement = bodies[body].face_displacement()[contact];
  const Eigen::MatrixXd& own = bodies[body].structure().residual_flexibility;
  if (own.size() == 0) return displacement;
  for (std::size_t k = 0; k < joint_of_[body].size(); ++k)
    displacement += own(contact, index(k)) * forces[index(joint_of_[body][k])];
  return displacement;
}

std::vector<Snapshot> JoinedBodies::state() const {
  std::vector<Snapshot> state;
  for (const StrikingBody& body : bodies) state.push_back(body.now);
  return state;
}

void JoinedBodies::restore(const std::vector<Snapshot>& state) {
  for (std::size_t b = 0; b < bodies.size(); ++b) bodies[b].now = state[b];
}

}  // namespace impulse
