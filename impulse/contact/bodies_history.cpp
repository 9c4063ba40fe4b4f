#include "impulse/contact/bodies_history.hpp"

#include "lib/contract/require.hpp"
#include "lib/transform/real_fft.hpp"

#include <array>
#include <utility>

namespace impulse {
namespace {

const Response* response_of(const ContactBody& body) {
  const auto* response = std::get_if<ResponseReference>(&body);
  return response == nullptr ? nullptr : &response->get();
}

const ModalModel* modes_of(const ContactBody& body) {
  const auto* modes = std::get_if<ModesReference>(&body);
  return modes == nullptr ? nullptr : &modes->get();
}

/// Second differences of U over Δt, the jump U(0+) = R left in U_0.
std::vector<double> smooth_weights(const PairResponse& pair, double step_s) {
  const std::vector<double>& u = pair.step_displacement_m_per_N;
  std::vector<double> w(u.size() - 1);
  w[0] = (u[1] - u[0]) / step_s;
  for (std::size_t k = 1; k < w.size(); ++k) w[k] = (u[k + 1] - 2 * u[k] + u[k - 1]) / step_s;
  return w;
}

void add(std::vector<double>& sum, const std::vector<double>& term) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += term[k];
}

std::array<ContactSide, 2> sides(const Joint& joint) { return {joint.first, joint.second}; }

}  // namespace

std::size_t contact_count(const ContactBody& body) {
  if (const Response* response = response_of(body)) return response->contact_count;
  return static_cast<std::size_t>(modes_of(body)->contact_count());
}

double residual_flexibility(const ContactBody& body, std::size_t i, std::size_t j) {
  if (const Response* response = response_of(body)) return response->pair(i, j).step_displacement_m_per_N[0];
  return modes_of(body)->residual_flexibility(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

std::vector<Joint> joints_of(const std::vector<ContactBody>& bodies) {
  require(bodies.size() >= 2, "an impact needs two bodies, not {}", bodies.size());
  std::vector<Joint> joints;
  if (bodies.size() == 2) {
    const std::size_t contacts = contact_count(bodies[0]);
    require(contacts == contact_count(bodies[1]),
            "the bodies have {} and {} contacts; they must meet at the same number of points", contacts,
            contact_count(bodies[1]));
    for (std::size_t i = 0; i < contacts; ++i) joints.push_back({{0, i}, {1, i}});
    return joints;
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::size_t needed = b == 0 || b + 1 == bodies.size() ? 1 : 2;
    require(contact_count(bodies[b]) == needed,
            "body {} of the chain has {} contacts; {} needed (an inner body has an entry and an exit: --face A,B)",
            b + 1, contact_count(bodies[b]), needed == 1 ? "1 is" : "2 are");
  }
  for (std::size_t c = 0; c + 1 < bodies.size(); ++c) joints.push_back({{c, c == 0 ? 0u : 1u}, {c + 1, 0}});
  return joints;
}

BodiesHistory::ModalBody::ModalBody(const ModalModel& modes, const UniformGrid& grid)
    : history(modes, grid.step_s), forces(history.contact_count(), 0.0), past(history.contact_count()) {
  for (std::vector<double>& values : past) values.reserve(grid.size - 1);
}

BodiesHistory::BodiesHistory(const std::vector<ContactBody>& bodies, const std::vector<Joint>& joints,
                             const UniformGrid& grid, std::function<void(double)> observer)
    : bodies_(bodies), joints_(joints), grid_(grid), observer_(std::move(observer)), modal_(bodies.size()) {
  bool any_sampled = false;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const ModalModel* modes = modes_of(bodies[b]);
    any_sampled = any_sampled || modes == nullptr;
    if (modes == nullptr) continue;
    modal_[b] = std::make_unique<ModalBody>(*modes, grid);
  }
  if (any_sampled) add_sampled_weights();
}

void BodiesHistory::add_sampled_weights() {
  const std::size_t p = joints_.size();
  std::vector<std::vector<double>> all(p * p, std::vector<double>(grid_.size - 1, 0.0));
  for (std::size_t i = 0; i < p; ++i)
    for (std::size_t j = 0; j < p; ++j)
      for (const ContactSide& here : sides(joints_[i]))
        for (const ContactSide& there : sides(joints_[j])) {
          const Response* response = response_of(bodies_[here.body]);
          if (here.body != there.body || response == nullptr) continue;
          add(all[i * p + j], smooth_weights(response->pair(here.contact, there.contact), grid_.step_s));
        }
  sampled_.emplace(std::move(all), p);
}

double BodiesHistory::within_step(std::size_t i, std::size_t j) const {
  double sum = sampled_ ? sampled_->within_step(i, j) : 0.0;
  for (const ContactSide& here : sides(joints_[i]))
    for (const ContactSide& there : sides(joints_[j]))
      if (here.body == there.body && modal_[here.body])
        sum += modal_[here.body]->history.within_step(here.contact, there.contact);
  return sum;
}

double BodiesHistory::past(std::size_t i) const {
  double sum = sampled_ ? sampled_->past(i) : 0.0;
  for (const ContactSide& side : sides(joints_[i]))
    if (modal_[side.body]) sum += modal_[side.body]->history.past(side.contact);
  return sum;
}

void BodiesHistory::push(std::span<const double> forces) {
  constexpr std::size_t observed_interval = 1024;
  if (sampled_) sampled_->push(forces);
  for (std::size_t i = 0; i < joints_.size(); ++i)
    for (const ContactSide& side : sides(joints_[i]))
      if (modal_[side.body]) modal_[side.body]->forces[side.contact] = forces[i];
  for (const std::unique_ptr<ModalBody>& body : modal_) {
    if (!body) continue;
    for (std::size_t i = 0; i < body->past.size(); ++i) body->past[i].push_back(body->history.past(i));
    body->history.push(body->forces);
  }
  ++steps_;
  if (observer_ && steps_ % observed_interval == 0)
    observer_(static_cast<double>(steps_) / static_cast<double>(grid_.size - 1));
}

std::vector<const std::vector<double>*> BodiesHistory::of_body(
    std::size_t body, const std::vector<std::vector<double>>& of_joints) const {
  std::vector<const std::vector<double>*> own(impulse::contact_count(bodies_[body]), nullptr);
  for (std::size_t j = 0; j < joints_.size(); ++j)
    for (const ContactSide& there : sides(joints_[j]))
      if (there.body == body) own[there.contact] = &of_joints[j];
  return own;
}

std::vector<double> BodiesHistory::velocity_into(const ContactSide& at,
                                                 const std::vector<std::vector<double>>& mean_forces,
                                                 const std::vector<std::vector<double>>& forces) const {
  const ContactBody& body = bodies_[at.body];
  const std::vector<const std::vector<double>*> means = of_body(at.body, mean_forces);
  std::vector<double> velocity =
      modal_[at.body] ? modal_velocity(*modal_[at.body], at, means) : sampled_velocity(*response_of(body), at, means);
  const std::vector<const std::vector<double>*> samples = of_body(at.body, forces);
  for (std::size_t j = 0; j < samples.size(); ++j) {
    const double r = residual_flexibility(body, at.contact, j);
    if (samples[j] == nullptr || r == 0) continue;
    const std::vector<double>& force = *samples[j];
    for (std::size_t n = 0; n < velocity.size(); ++n)
      velocity[n] += r * (force[n + 1] - (n == 0 ? 0.0 : force[n])) / grid_.step_s;
  }
  return velocity;
}

std::vector<double> BodiesHistory::sampled_velocity(const Response& body, const ContactSide& at,
                                                    const std::vector<const std::vector<double>*>& forces) const {
  std::vector<double> velocity(grid_.size - 1, 0.0);
  for (std::size_t j = 0; j < forces.size(); ++j)
    if (forces[j] != nullptr)
      add(velocity, convolution(smooth_weights(body.pair(at.contact, j), grid_.step_s), *forces[j], velocity.size()));
  return velocity;
}

std::vector<double> BodiesHistory::modal_velocity(const ModalBody& body, const ContactSide& at,
                                                  const std::vector<const std::vector<double>*>& forces) const {
  std::vector<double> velocity = body.past[at.contact];
  for (std::size_t j = 0; j < forces.size(); ++j) {
    if (forces[j] == nullptr) continue;
    const double within = body.history.within_step(at.contact, j);
    for (std::size_t n = 0; n < velocity.size(); ++n) velocity[n] += within * (*forces[j])[n];
  }
  return velocity;
}

}  // namespace impulse
