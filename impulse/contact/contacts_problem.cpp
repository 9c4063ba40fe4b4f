#include "impulse/contact/contacts_problem.hpp"

#include "impulse/contact/step_means.hpp"
#include "lib/contract/require.hpp"
#include "lib/transform/real_fft.hpp"

#include <algorithm>
#include <cmath>

namespace impulse {
namespace {

/// Where a contact meets a body: which of the body's contacts.
struct Side {
  std::size_t body;
  std::size_t contact;
};

/// A contact presses body `first` at its side and pushes body `second`.
struct Joint {
  Side first;
  Side second;
};

std::vector<Joint> joints_of(const std::vector<Response>& bodies) {
  require(bodies.size() >= 2, "an impact needs two bodies, not {}", bodies.size());
  std::vector<Joint> joints;
  if (bodies.size() == 2) {
    require(bodies[0].contact_count == bodies[1].contact_count,
            "the bodies have {} and {} contacts; they must meet at the same number of points", bodies[0].contact_count,
            bodies[1].contact_count);
    for (std::size_t i = 0; i < bodies[0].contact_count; ++i) joints.push_back({{0, i}, {1, i}});
    return joints;
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::size_t needed = b == 0 || b + 1 == bodies.size() ? 1 : 2;
    require(bodies[b].contact_count == needed,
            "body {} of the chain has {} contacts; {} needed (an inner body has an entry and an exit: --face A,B)",
            b + 1, bodies[b].contact_count, needed == 1 ? "1 is" : "2 are");
  }
  for (std::size_t c = 0; c + 1 < bodies.size(); ++c) joints.push_back({{c, c == 0 ? 0u : 1u}, {c + 1, 0}});
  return joints;
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

/// Mean velocity into a body at one of its contacts, over each step, under the forces at all of them.
std::vector<double> velocity_into(const Response& body, std::size_t at,
                                  const std::vector<const std::vector<double>*>& forces, double step_s) {
  std::vector<double> velocity(body.grid.size - 1, 0.0);
  for (std::size_t j = 0; j < body.contact_count; ++j) {
    if (forces[j] == nullptr) continue;
    const PairResponse& pair = body.pair(at, j);
    add(velocity, convolution(smooth_weights(pair, step_s), *forces[j], velocity.size()));
    // A residual flexibility R adds R F', the difference of the force at the step's ends: here of its means, to order 1
    // at worst and only in the face's motion.
    const double r = pair.step_displacement_m_per_N[0];
    if (r == 0) continue;
    for (std::size_t n = 0; n < velocity.size(); ++n)
      velocity[n] += r * ((*forces[j])[n] - (n == 0 ? 0.0 : (*forces[j])[n - 1])) / step_s;
  }
  return velocity;
}

std::vector<double> running_sum(const std::vector<double>& steps, double step_s) {
  std::vector<double> sum(steps.size() + 1);
  for (std::size_t n = 0; n < steps.size(); ++n) sum[n + 1] = sum[n] + step_s * steps[n];
  return sum;
}

class Problem {
 public:
  Problem(const std::vector<Response>& bodies, const ContactsProblem& given)
      : bodies_(bodies), given_(given), joints_(joints_of(bodies)) {
    for (const Response& body : bodies) {
      require_valid(body);
      require(same_grid(body.grid, bodies[0].grid),
              "the responses have different grids ({} samples of {:.6g} s and {} samples of {:.6g} s); compute all "
              "with the same --step and --duration",
              bodies[0].grid.size, bodies[0].grid.step_s, body.grid.size, body.grid.step_s);
    }
    require(given.speed_m_per_s.size() == bodies.size(), "{} speeds for {} bodies", given.speed_m_per_s.size(),
            bodies.size());
    require(given.laws.size() == joints_.size(),
            "{} contact laws for {} contacts; give one for all or one each (--law)", given.laws.size(), joints_.size());
    require(given.gaps_m.size() == joints_.size(), "{} gaps for {} contacts; give one for all or one each (--gap)",
            given.gaps_m.size(), joints_.size());
    for (const auto* free : {&given.free_velocity_first_m_per_s, &given.free_velocity_last_m_per_s})
      require(free->empty() || free->size() == grid().size, "a free velocity of {} samples for responses of {}",
              free->size(), grid().size);
  }

  [[nodiscard]] ContactsSolution solve() const {
    const std::vector<MarchedContact> contacts = marched_contacts();
    const std::vector<MarchedHistory> histories = march_contacts(grid(), contacts, weights(), given_.recontact);
    ContactsSolution solution;
    double mismatch = 0;
    double scale = 0;
    for (std::size_t c = 0; c < joints_.size(); ++c) {
      solution.traces.push_back(trace(c, histories));
      solution.in_contact_at_end = solution.in_contact_at_end || histories[c].in_contact.back();
      double work = 0;
      for (std::size_t n = 0; n + 1 < grid().size; ++n) {
        work += histories[c].mean_force_N[n] * (histories[c].approach_m[n + 1] - histories[c].approach_m[n]);
        scale += std::abs(histories[c].mean_force_N[n] * contacts[c].approach_m_per_s[n]) * grid().step_s;
      }
      mismatch += work - taken_up(histories[c], grid().size - 1) + taken_up(histories[c], 0);
    }
    solution.energy_error = scale > 0 ? std::abs(mismatch) / scale : 0;
    return solution;
  }

 private:
  [[nodiscard]] const UniformGrid& grid() const { return bodies_[0].grid; }

  static double taken_up(const MarchedHistory& history, std::size_t n) {
    return history.stored_J[n] + history.residual_J[n] + history.dissipated_J[n];
  }

  /// Kernel of what a force at contact j takes back of the approach at contact i.
  [[nodiscard]] std::vector<std::vector<double>> weights() const {
    const std::size_t p = joints_.size();
    std::vector<std::vector<double>> all(p * p, std::vector<double>(grid().size - 1, 0.0));
    for (std::size_t i = 0; i < p; ++i)
      for (std::size_t j = 0; j < p; ++j)
        for (const Side& here : {joints_[i].first, joints_[i].second})
          for (const Side& there : {joints_[j].first, joints_[j].second})
            if (here.body == there.body)
              add(all[i * p + j], smooth_weights(bodies_[here.body].pair(here.contact, there.contact), grid().step_s));
    return all;
  }

  [[nodiscard]] double residual_flexibility(std::size_t contact) const {
    double r = 0;
    for (const Side& side : {joints_[contact].first, joints_[contact].second})
      r += bodies_[side.body].pair(side.contact, side.contact).step_displacement_m_per_N[0];
    return r;
  }

  [[nodiscard]] std::vector<double> free_velocity(std::size_t body) const {
    std::vector<double> mean(grid().size - 1, given_.speed_m_per_s[body]);
    for (const auto& [own, free] : {std::pair{std::size_t{0}, &given_.free_velocity_first_m_per_s},
                                    {bodies_.size() - 1, &given_.free_velocity_last_m_per_s}})
      if (body == own && !free->empty())
        for (std::size_t n = 0; n < mean.size(); ++n) mean[n] += 0.5 * ((*free)[n] + (*free)[n + 1]);
    return mean;
  }

  [[nodiscard]] std::vector<MarchedContact> marched_contacts() const {
    std::vector<MarchedContact> contacts;
    for (std::size_t c = 0; c < joints_.size(); ++c) {
      MarchedContact contact;
      contact.law = given_.laws[c];
      contact.residual_flexibility_m_per_N = residual_flexibility(c);
      contact.gap_m = given_.gaps_m[c];
      contact.preload_N = given_.preload_N;
      contact.approach_m_per_s = free_velocity(joints_[c].first.body);
      const std::vector<double> receding = free_velocity(joints_[c].second.body);
      for (std::size_t n = 0; n < receding.size(); ++n) contact.approach_m_per_s[n] -= receding[n];
      contacts.push_back(std::move(contact));
    }
    return contacts;
  }

  [[nodiscard]] ContactTrace trace(std::size_t c, const std::vector<MarchedHistory>& histories) const {
    const MarchedHistory& own = histories[c];
    ContactTrace trace;
    trace.force_N = own.force_N;
    trace.running_impulse_Ns = running_sum(own.mean_force_N, grid().step_s);
    trace.indentation_m = own.indentation_m;
    trace.stored_J = own.stored_J;
    trace.dissipated_J = own.dissipated_J;
    trace.in_contact = own.in_contact;
    fill_side(joints_[c].first, -1, histories, own.mean_force_N, trace.velocity_1_m_per_s, trace.displacement_1_m,
              trace.work_1_J);
    fill_side(joints_[c].second, +1, histories, own.mean_force_N, trace.velocity_2_m_per_s, trace.displacement_2_m,
              trace.work_2_J);
    return trace;
  }

  /// Motion of one face, along the row (direction -1: into the body is against it), and the work that the contact's
  /// force did on it.
  void fill_side(const Side& side, double direction, const std::vector<MarchedHistory>& histories,
                 const std::vector<double>& own_force, std::vector<double>& velocity, std::vector<double>& displacement,
                 std::vector<double>& work) const {
    const Response& body = bodies_[side.body];
    // The force beyond the preload, at every contact of this body.
    std::vector<std::vector<double>> beyond(body.contact_count);
    std::vector<const std::vector<double>*> forces(body.contact_count, nullptr);
    for (std::size_t j = 0; j < joints_.size(); ++j)
      for (const Side& there : {joints_[j].first, joints_[j].second})
        if (there.body == side.body) {
          beyond[there.contact] = histories[j].mean_force_N;
          for (double& force : beyond[there.contact]) force -= given_.preload_N;
          forces[there.contact] = &beyond[there.contact];
        }
    std::vector<double> mean = free_velocity(side.body);
    const std::vector<double> into = velocity_into(body, side.contact, forces, grid().step_s);
    std::vector<double> power(mean.size());
    for (std::size_t n = 0; n < mean.size(); ++n) {
      mean[n] += direction * into[n];
      power[n] = direction * own_force[n] * mean[n];
    }
    velocity = on_samples(mean, mean.front(), mean.back());
    displacement = running_sum(mean, grid().step_s);
    work = running_sum(power, grid().step_s);
  }

  const std::vector<Response>& bodies_;
  const ContactsProblem& given_;
  std::vector<Joint> joints_;
};

}  // namespace

ContactsSolution solve_contacts(const std::vector<Response>& bodies, const ContactsProblem& problem) {
  return Problem(bodies, problem).solve();
}

}  // namespace impulse
