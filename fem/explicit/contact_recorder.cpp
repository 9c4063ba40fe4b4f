#include "fem/explicit/contact_recorder.hpp"

#include <optional>

namespace impulse {
namespace {

std::vector<std::vector<double>*> columns(ContactTrace& trace) {
  return {&trace.force_N,
          &trace.running_impulse_Ns,
          &trace.indentation_m,
          &trace.stored_J,
          &trace.dissipated_J,
          &trace.velocity_1_m_per_s,
          &trace.velocity_2_m_per_s,
          &trace.displacement_1_m,
          &trace.displacement_2_m,
          &trace.work_1_J,
          &trace.work_2_J};
}

}  // namespace

ContactRecorder::ContactRecorder(const JoinedBodies& bodies, const std::vector<ExplicitBody>& flights,
                                 const UniformGrid& grid)
    : now(bodies.contact_count()), bodies_(bodies), flights_(flights), grid_(grid) {
  for (std::size_t i = 0; i < now.size(); ++i) {
    for (std::vector<double>* column : columns(now[i])) column->assign(grid.size, 0.0);
    now[i].in_contact.assign(grid.size, false);
    now[i].velocity_1_m_per_s[0] = flights_[bodies.joint(i).body_1].speed_m_per_s;
    now[i].velocity_2_m_per_s[0] = flights_[bodies.joint(i).body_2].speed_m_per_s;
  }
}

void ContactRecorder::motion(std::size_t n, const Eigen::VectorXd& law_forces) {
  const double time = grid_.time_s(n);
  for (std::size_t i = 0; i < now.size(); ++i) {
    const RowJoint& joint = bodies_.joint(i);
    const double speed_1 = flights_[joint.body_1].speed_m_per_s, speed_2 = flights_[joint.body_2].speed_m_per_s;
    now[i].velocity_1_m_per_s[n] = speed_1 - bodies_.bodies[joint.body_1].face_velocity()[joint.contact_1];
    now[i].velocity_2_m_per_s[n] = speed_2 + bodies_.bodies[joint.body_2].face_velocity()[joint.contact_2];
    now[i].displacement_1_m[n] = speed_1 * time - bodies_.face_displacement(joint.body_1, joint.contact_1, law_forces);
    now[i].displacement_2_m[n] = speed_2 * time + bodies_.face_displacement(joint.body_2, joint.contact_2, law_forces);
  }
}

void ContactRecorder::jump(std::size_t n, const Eigen::MatrixX2d& velocities) {
  for (std::size_t i = 0; i < now.size(); ++i) {
    now[i].velocity_1_m_per_s[n] -= velocities(static_cast<Eigen::Index>(i), 0);
    now[i].velocity_2_m_per_s[n] += velocities(static_cast<Eigen::Index>(i), 1);
  }
}

void ContactRecorder::rigid_step(std::size_t contact, std::size_t n, double begin_N, double end_N) {
  ContactTrace& trace = now[contact];
  const auto work = [&](const std::vector<double>& v) {
    return 0.5 * grid_.step_s * (begin_N * v[n - 1] + end_N * v[n]);
  };
  trace.running_impulse_Ns[n] = trace.running_impulse_Ns[n - 1] + 0.5 * grid_.step_s * (begin_N + end_N);
  trace.work_1_J[n] = trace.work_1_J[n - 1] - work(trace.velocity_1_m_per_s);
  trace.work_2_J[n] = trace.work_2_J[n - 1] + work(trace.velocity_2_m_per_s);
}

void ContactRecorder::release_step(std::size_t contact, std::size_t n, double begin_N, double part) {
  ContactTrace& trace = now[contact];
  const double impulse = 0.5 * begin_N * part * grid_.step_s;
  // The centre of the triangle is a third of the way down.
  const auto velocity = [&](const std::vector<double>& v) { return v[n - 1] + part / 3 * (v[n] - v[n - 1]); };
  trace.running_impulse_Ns[n] = trace.running_impulse_Ns[n - 1] + impulse;
  trace.work_1_J[n] = trace.work_1_J[n - 1] - impulse * velocity(trace.velocity_1_m_per_s);
  trace.work_2_J[n] = trace.work_2_J[n - 1] + impulse * velocity(trace.velocity_2_m_per_s);
}

void ContactRecorder::law_step(std::size_t contact, std::size_t n, double mean_force) {
  ContactTrace& trace = now[contact];
  const auto way = [n](const std::vector<double>& d) { return d[n] - d[n - 1]; };
  trace.running_impulse_Ns[n] = trace.running_impulse_Ns[n - 1] + mean_force * grid_.step_s;
  trace.work_1_J[n] = trace.work_1_J[n - 1] - mean_force * way(trace.displacement_1_m);
  trace.work_2_J[n] = trace.work_2_J[n - 1] + mean_force * way(trace.displacement_2_m);
}

double ContactRecorder::offered_J(std::size_t n) const {
  double offered = 0;
  for (std::size_t i = 0; i < now.size(); ++i) offered += bodies_.flight_speed(i) * now[i].running_impulse_Ns[n];
  return offered;
}

std::vector<ContactTrace> ContactRecorder::traces(std::size_t size) const {
  std::vector<ContactTrace> traces = now;
  for (ContactTrace& trace : traces) {
    for (std::vector<double>* column : columns(trace)) column->resize(size);
    trace.in_contact.resize(size);
  }
  return traces;
}

BodyBalance balance(const StrikingBody& body, const ExplicitBody& flight, std::size_t index) {
  BodyBalance balance{.strain_energy_J = body.strain_energy(),
                      .dissipated_J = body.now.dissipated_J,
                      .step_s = body.step_s(),
                      .step_count = body.step_count()};
  balance.kinetic_energy_J = body.kinetic_energy();
  const std::optional<Eigen::VectorXd> translation = rigid_translation(flight.structure);
  if (!translation) return balance;
  const double mass = translation->dot(flight.structure.mass * *translation), speed = flight.speed_m_per_s;
  // The first body flies against its functional.
  const double momentum = (index == 0 ? -1 : 1) * body.momentum(*translation);
  balance.momentum_Ns = mass * speed + momentum;
  balance.kinetic_energy_J += 0.5 * mass * speed * speed + speed * momentum;
  return balance;
}

}  // namespace impulse
